// All programs of the page. Lights go with the camera, so that every side is lit.
const kLight = `
  vec3 lit(vec3 colour, vec3 normal, vec3 toEye) {
    float facing = abs(dot(normalize(normal), normalize(toEye)));
    return colour * (0.55 + 0.45 * facing) + vec3(0.12) * pow(facing, 24.0);
  }`;

const kUniforms = `#version 300 es
  precision highp float;
  uniform mat4 view, projection;
  uniform vec3 eye;`;

const kFragmentHead = `#version 300 es
  precision highp float;
  in vec3 normal, toEye, colour;
  out vec4 fragment;
  ${kLight}`;

/// The shape: clear where one looks straight at it, denser at its outline.
const kSurface = {
  vertex: `${kUniforms}
  in vec3 place, bend, tint;
  out vec3 normal, toEye, colour;
  void main() {
    vec3 at = place * 2.0 - 1.0;
    normal = bend, toEye = eye - at, colour = tint;
    gl_Position = projection * view * vec4(at, 1);
  }`,
  fragment: `${kFragmentHead}
  uniform float opacity;
  void main() {
    float edge = 1.0 - abs(dot(normalize(normal), normalize(toEye)));
    float alpha = mix(opacity * (0.3 + 0.7 * edge * edge), 1.0, step(0.995, opacity));
    fragment = vec4(lit(colour, normal, toEye), alpha);
  }`,
};

/// The points of a cloud as round dots.
const kDots = {
  vertex: `${kUniforms}
  uniform float size;
  in vec3 place, tint;
  out vec3 normal, toEye, colour;
  void main() {
    vec3 at = place * 2.0 - 1.0;
    normal = toEye = eye - at, colour = tint;
    gl_Position = projection * view * vec4(at, 1);
    gl_PointSize = size;
  }`,
  fragment: `${kFragmentHead}
  uniform float opacity;
  void main() {
    if (length(gl_PointCoord - 0.5) > 0.5) discard;
    fragment = vec4(colour, opacity);
  }`,
};

/// Tubes between two places, one a copy.
const kTubes = {
  vertex: `${kUniforms}
  uniform float width;
  in vec3 ring;
  in vec3 from, to, fromTint, toTint;
  in vec2 reach;
  out vec3 normal, toEye, colour;
  void main() {
    vec3 line = to - from;
    float size = length(line);
    line = size > 0.0 ? line / size : vec3(1, 0, 0);
    vec3 aside = normalize(cross(line, abs(line.x) < 0.7 ? vec3(1, 0, 0) : vec3(0, 1, 0)));
    normal = aside * ring.x + cross(line, aside) * ring.y;
    vec3 at = mix(from, to, ring.z) + normal * min(width, mix(reach.x, reach.y, ring.z));
    toEye = eye - at, colour = mix(fromTint, toTint, ring.z);
    gl_Position = projection * view * vec4(at, 1);
  }`,
  fragment: `${kFragmentHead}
  void main() { fragment = vec4(lit(colour, normal, toEye), 1); }`,
};

/// Balls around places, one a copy.
const kBalls = {
  vertex: `${kUniforms}
  uniform float most;
  in vec3 corner;
  in vec3 middle, tint;
  in float radius;
  out vec3 normal, toEye, colour;
  void main() {
    vec3 at = middle + corner * min(radius, most);
    normal = corner, toEye = eye - at, colour = tint;
    gl_Position = projection * view * vec4(at, 1);
  }`,
  fragment: `${kFragmentHead}
  uniform float opacity;
  void main() {
    float edge = 1.0 - abs(dot(normalize(normal), normalize(toEye)));
    float alpha = mix(opacity * (0.4 + 0.6 * edge), 1.0, step(0.995, opacity));
    fragment = vec4(lit(colour, normal, toEye), alpha);
  }`,
};
