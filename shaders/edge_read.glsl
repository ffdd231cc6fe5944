// The gradient plane as the edge_* shaders read it; the including shader has declared gradient[]
// and push.width.
struct Across {
  ivec2 axis;  // towards the nearest neighbour across the edge
  ivec2 turn;  // signs of the gradient: towards the diagonal one
  uint larger;
  uint smaller;
};

ivec2 gradient_at(ivec2 p) {
  const int pair = int(gradient[uint(p.y) * push.width + uint(p.x)]);
  return ivec2(bitfieldExtract(pair, 0, 16), bitfieldExtract(pair, 16, 16));
}

uint squared_at(ivec2 p) {
  const ivec2 g = gradient_at(p);
  return uint(g.x * g.x + g.y * g.y);
}

Across across_edge(ivec2 g) {
  const ivec2 turn = ivec2(g.x < 0 ? -1 : 1, g.y < 0 ? -1 : 1);
  const uvec2 size = uvec2(abs(g));
  if (size.x >= size.y) return Across(ivec2(turn.x, 0), turn, size.x, size.y);
  return Across(ivec2(0, turn.y), turn, size.y, size.x);
}
