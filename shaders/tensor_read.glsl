// Values of a tensor bound in bands. The including shader has included tensor_bands.h.
layout(constant_id = 0) const uint BANDS = 1;
layout(binding = 0) readonly buffer Band0 { uint band0[]; };
layout(binding = 1) readonly buffer Band1 { uint band1[]; };
layout(binding = 2) readonly buffer Band2 { uint band2[]; };
layout(binding = 3) readonly buffer Band3 { uint band3[]; };

// Branches, since not every device can index bindings; with one band they fold away.
uint band_word(uint band, uint i) {
  if (BANDS == 1u || band == 0u) return band0[i];
  if (BANDS == 2u || band == 1u) return band1[i];
  if (BANDS == 3u || band == 2u) return band2[i];
  return band3[i];
}

// In 1/256 px.
uint tensor_at(TensorGrid grid, uint x, uint y, uint bin) {
  const uint band = BANDS == 1u ? 0u : y / grid.band_rows;
  const uint row = y - band * grid.band_rows;
  const uint i = ((row * grid.tiles_per_row + x / DCD_TILE) * grid.bins + bin) * DCD_TILE + x % DCD_TILE;
  const uint word = band_word(band, i >> 1);
  return (i & 1u) != 0u ? word >> 16 : word & 0xffffu;
}
