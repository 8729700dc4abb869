// Programs, buffers and what is drawn by them, on WebGL 2.
class Program {
  constructor(gl, {vertex, fragment}) {
    this.gl = gl;
    this.program = gl.createProgram();
    for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost())
        throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(this.program, shader);
    }
    gl.linkProgram(this.program);
    this.places = new Map();
  }

  uniform(name) {
    if (!this.places.has(name)) this.places.set(name, this.gl.getUniformLocation(this.program, name));
    return this.places.get(name);
  }

  /// With the camera and any numbers by name.
  use(camera, numbers = {}) {
    const gl = this.gl;
    gl.useProgram(this.program);
    gl.uniformMatrix4fv(this.uniform("view"), false, camera.view);
    gl.uniformMatrix4fv(this.uniform("projection"), false, camera.projection);
    gl.uniform3fv(this.uniform("eye"), camera.eye);
    for (const [name, number] of Object.entries(numbers)) gl.uniform1f(this.uniform(name), number);
  }
}

/// Arrays by the names of a program's inputs: {array, size, normalized, each: one for a copy}.
class Batch {
  constructor(gl, program, inputs, indices = null) {
    this.gl = gl;
    this.arrays = gl.createVertexArray();
    gl.bindVertexArray(this.arrays);
    this.buffers = {};
    this.count = this.copies = 0;
    for (const [name, input] of Object.entries(inputs)) this.add(program, name, input);
    if (indices) {
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
      this.count = indices.length;
    }
    this.hasIndices = indices !== null;
    gl.bindVertexArray(null);
  }

  add(program, name, {array, size, normalized = false, each = false}) {
    const gl = this.gl, place = gl.getAttribLocation(program.program, name);
    this.buffers[name] = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[name]);
    gl.bufferData(gl.ARRAY_BUFFER, array, gl.STATIC_DRAW);
    const type = {Uint8Array: gl.UNSIGNED_BYTE, Int8Array: gl.BYTE, Uint16Array: gl.UNSIGNED_SHORT,
                  Float32Array: gl.FLOAT}[array.constructor.name];
    if (each) this.copies = array.length / size;
    else this.count = array.length / size;
    if (place < 0) return;
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, size, type, normalized, 0, 0);
    gl.vertexAttribDivisor(place, each ? 1 : 0);
  }

  replace(name, array) {
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, this.buffers[name]);
    this.gl.bufferData(this.gl.ARRAY_BUFFER, array, this.gl.DYNAMIC_DRAW);
  }

  draw(mode) {
    const gl = this.gl;
    gl.bindVertexArray(this.arrays);
    if (this.hasIndices && this.copies > 0)
      gl.drawElementsInstanced(mode, this.count, gl.UNSIGNED_SHORT, 0, this.copies);
    else if (this.hasIndices) gl.drawElements(mode, this.count, gl.UNSIGNED_SHORT, 0);
    else gl.drawArrays(mode, 0, this.count);
  }
}

/// A tube of one unit: [cos, sin, 0 or 1] round about, and its triangles.
function makeTube(sides) {
  const ring = [], indices = [];
  for (let i = 0; i < sides; ++i) {
    const angle = 2 * Math.PI * i / sides, a = 2 * i, b = 2 * ((i + 1) % sides);
    ring.push(Math.cos(angle), Math.sin(angle), 0, Math.cos(angle), Math.sin(angle), 1);
    indices.push(a, b, a + 1, a + 1, b, b + 1);
  }
  return {ring: new Float32Array(ring), indices: new Uint16Array(indices)};
}

/// A ball of radius one in bands.
function makeBall(around, bands) {
  const corner = [], indices = [];
  for (let j = 0; j <= bands; ++j)
    for (let i = 0; i <= around; ++i) {
      const tilt = Math.PI * j / bands, angle = 2 * Math.PI * i / around;
      corner.push(Math.sin(tilt) * Math.cos(angle), Math.cos(tilt), Math.sin(tilt) * Math.sin(angle));
      const a = j * (around + 1) + i, b = a + around + 1;
      if (i < around && j < bands) indices.push(a, a + 1, b, b, a + 1, b + 1);
    }
  return {corner: new Float32Array(corner), indices: new Uint16Array(indices)};
}

/// Normals of points, each the sum of those of its triangles.
function normalsOf(positions, triangles) {
  const sum = new Float32Array(positions.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
    const ux = positions[b] - positions[a], uy = positions[b + 1] - positions[a + 1],
          uz = positions[b + 2] - positions[a + 2], vx = positions[c] - positions[a],
          vy = positions[c + 1] - positions[a + 1], vz = positions[c + 2] - positions[a + 2];
    const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    for (const i of [a, b, c]) sum[i] += nx, sum[i + 1] += ny, sum[i + 2] += nz;
  }
  const normals = new Int8Array(positions.length);
  for (let i = 0; i < sum.length; i += 3) {
    const length = Math.hypot(sum[i], sum[i + 1], sum[i + 2]) || 1;
    for (let k = 0; k < 3; ++k) normals[i + k] = Math.round(127 * sum[i + k] / length);
  }
  return normals;
}
