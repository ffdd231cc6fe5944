// Angles of undirected lines, alike on every device.
const float PI = 3.14159265358979;

// |error| <= 2e-7 rad on every device, where the built-in may be off by 4096 ULP (Abramowitz and
// Stegun 4.4.49).
float atan_unit(float t) {
  const float t2 = t * t;
  float p = 0.0028662257;
  p = p * t2 - 0.0161657367;
  p = p * t2 + 0.0429096138;
  p = p * t2 - 0.0752896400;
  p = p * t2 + 0.1065626393;
  p = p * t2 - 0.1420889944;
  p = p * t2 + 0.1999355085;
  p = p * t2 - 0.3333314528;
  return t + t * t2 * p;
}

// Orientation of an undirected line, [0, pi).
float undirected_angle(vec2 d) {
  const vec2 a = abs(d);
  const float big = max(a.x, a.y), small = min(a.x, a.y);
  if (big == 0.0) return 0.0;
  float angle = atan_unit(small / big);
  if (a.y > a.x) angle = 0.5 * PI - angle;
  if ((d.x < 0.0) != (d.y < 0.0)) angle = PI - angle;
  return angle >= PI ? angle - PI : angle;
}
