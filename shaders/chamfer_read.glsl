// Bits of four combinations as four bytes of 0 or 1.
uint bytes_of(uint quad) { return (quad * 0x00204081u) & 0x01010101u; }
