// The shape and the lines as they are drawn.
const kTubeWidth = 0.011, kStageWidth = 0.004, kJointWidth = 0.02;
const kThinnest = 0.45;  // of a limb that a tube may fill

/// How thick a tube may be in a limb.
function tubeReach(radius) { return Math.max(kThinnest * radius, 0.5 * kStageWidth); }

/// Joints and tips stay easy to see where limbs are thin.
function markReach(radius) { return Math.max(radius, 0.6 * kJointWidth); }

class Scene {
  constructor(canvas, data, look) {
    const gl = canvas.getContext("webgl2", {antialias: true, alpha: false});
    if (!gl) throw new Error("no WebGL 2");
    this.gl = gl, this.canvas = canvas, this.data = data;
    this.programs = {surface: new Program(gl, kSurface), dots: new Program(gl, kDots),
                     tubes: new Program(gl, kTubes), balls: new Program(gl, kBalls)};
    this.shape = this.shapeBatch(data.shape);
    this.lines = data.lines.map((lines, i) => this.lineBatches(lines, i));
    this.paint(look);
  }

  shapeBatch({positions, triangles}) {
    this.shapeTint = new Uint8Array(positions.length);
    const inputs = {place: {array: positions, size: 3, normalized: true},
                    tint: {array: this.shapeTint, size: 3, normalized: true}};
    if (triangles.length === 0) return new Batch(this.gl, this.programs.dots, inputs);
    inputs.bend = {array: normalsOf(positions, triangles), size: 3, normalized: true};
    return new Batch(this.gl, this.programs.surface, inputs, triangles);
  }

  lineBatches(lines, number) {
    const {positions, radii, edges} = lines, degrees = degreesOf(lines);
    const nodes = Array.from(radii.keys());
    const isEnd = n => degrees[n] !== 2;
    return {
      tubes: this.tubeBatch(positions, radii, edges),
      edges, nodes, degrees,
      knots: this.ballBatch(lines, nodes, 10, 6, tubeReach),
      marks: this.ballBatch(lines, nodes.filter(isEnd), 16, 10, markReach),
      balls: number > 0 ? null : {all: this.ballBatch(lines, nodes, 32, 20),
                                  ends: this.ballBatch(lines, nodes.filter(isEnd), 32, 20)},
    };
  }

  tubeBatch(positions, radii, edges) {
    const from = new Float32Array(edges.length / 2 * 3), to = new Float32Array(from.length);
    const reach = new Float32Array(edges.length);
    for (let e = 0; e < edges.length / 2; ++e) {
      from.set(positions.subarray(3 * edges[2 * e], 3 * edges[2 * e] + 3), 3 * e);
      to.set(positions.subarray(3 * edges[2 * e + 1], 3 * edges[2 * e + 1] + 3), 3 * e);
      for (const k of [0, 1])
        reach[2 * e + k] = tubeReach(radii[edges[2 * e + k]]);
    }
    const {ring, indices} = makeTube(10), tint = new Uint8Array(from.length);
    const each = (array, size, normalized = false) => ({array, size, normalized, each: true});
    return new Batch(this.gl, this.programs.tubes, {
      ring: {array: ring, size: 3}, from: each(from, 3), to: each(to, 3), reach: each(reach, 2),
      fromTint: each(tint, 3, true), toTint: each(tint, 3, true)}, indices);
  }

  ballBatch({positions, radii}, nodes, around, bands, reach = radius => radius) {
    const middle = new Float32Array(3 * nodes.length);
    nodes.forEach((n, i) => middle.set(positions.subarray(3 * n, 3 * n + 3), 3 * i));
    const {corner, indices} = makeBall(around, bands);
    const batch = new Batch(this.gl, this.programs.balls, {
      corner: {array: corner, size: 3}, middle: {array: middle, size: 3, each: true},
      radius: {array: new Float32Array(nodes.map(n => reach(radii[n]))), size: 1, each: true},
      tint: {array: new Uint8Array(middle.length), size: 3, normalized: true, each: true}}, indices);
    batch.nodes = nodes;
    return batch;
  }

  /// New colours: {byBranch, colours: paper, surface, joint, tip, stages, radii}.
  paint(look) {
    this.look = look;
    const {branches} = this.data.shape, {colours, byBranch} = look;
    const palette = this.data.palette.map(colourOf);
    const withBranches = byBranch && branches.length > 0 && palette.length > 0;
    for (let i = 0; i < this.shapeTint.length / 3; ++i)
      this.shapeTint.set(withBranches ? palette[branches[i] % palette.length] : colours.surface, 3 * i);
    this.shape.replace("tint", this.shapeTint);
    this.lines.forEach((batches, i) => this.paintLines(batches, this.data.lines[i], i, palette));
  }

  paintLines(batches, lines, number, palette) {
    const {byBranch, colours} = this.look;
    const [thin, thick] = rangeOf(lines.radii), scale = colours.radii;
    const byRadius = n => along(scale, (lines.radii[n] - thin) / (thick - thin));
    const ofNode = [];
    const ofEdge = e => {
      const branch = palette[lines.branches[e] % palette.length] || colours.surface;
      return number > 0 ? colours.stages[(number - 1) % colours.stages.length] : branch;
    };
    const plain = number > 0 || byBranch;
    const from = [], to = [];
    for (let e = 0; e < lines.edges.length / 2; ++e) {
      const [a, b] = [lines.edges[2 * e], lines.edges[2 * e + 1]];
      from.push(...plain ? ofEdge(e) : byRadius(a)), to.push(...plain ? ofEdge(e) : byRadius(b));
      ofNode[a] = ofNode[b] = ofEdge(e);
    }
    batches.tubes.replace("fromTint", new Uint8Array(from));
    batches.tubes.replace("toTint", new Uint8Array(to));
    const colour = n => plain ? ofNode[n] || colours.surface : byRadius(n);
    const mark = n => batches.degrees[n] > 2 ? colours.joint : batches.degrees[n] ? colours.tip : colour(n);
    const tint = (batch, of) => batch.replace("tint", new Uint8Array(batch.nodes.flatMap(of)));
    tint(batches.knots, colour);
    tint(batches.marks, mark);
    if (batches.balls) tint(batches.balls.all, colour), tint(batches.balls.ends, colour);
  }

  /// `shown`: {surface, opacity, balls, lines: a flag each}.
  draw(camera, shown) {
    const gl = this.gl, [width, height] = [this.canvas.width, this.canvas.height];
    gl.viewport(0, 0, width, height);
    gl.clearColor(...this.look.colours.paper.map(c => c / 255), 1);
    gl.depthMask(true);
    gl.disable(gl.BLEND);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const matrices = camera.matrices(width / height);
    // Tubes keep more or less their width when one looks closer.
    const closer = 1 / Math.max(1, camera.zoom) ** 0.7;
    this.lines.forEach((batches, i) => {
      if (shown.lines[i]) this.drawLines(matrices, batches, i === 0, closer);
    });
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    if (shown.balls !== "none" && this.lines[0]) this.drawBalls(matrices, this.lines[0].balls[shown.balls]);
    if (shown.surface) this.drawShape(matrices, shown.opacity, camera.zoom);
    return matrices;
  }

  drawLines(matrices, {tubes, knots, marks}, isSkeleton, closer) {
    const gl = this.gl, width = (isSkeleton ? kTubeWidth : kStageWidth) * closer;
    this.programs.tubes.use(matrices, {width});
    tubes.draw(gl.TRIANGLES);
    this.programs.balls.use(matrices, {most: width, opacity: 1});
    knots.draw(gl.TRIANGLES);
    if (!isSkeleton) return;
    this.programs.balls.use(matrices, {most: kJointWidth * closer, opacity: 1});
    marks.draw(gl.TRIANGLES);
  }

  /// Only the outermost balls, so that many of them do not add up to a fog.
  drawBalls(matrices, balls) {
    const gl = this.gl;
    this.programs.balls.use(matrices, {most: 1000, opacity: 0.4});
    gl.colorMask(false, false, false, false);
    balls.draw(gl.TRIANGLES);
    gl.colorMask(true, true, true, true);
    balls.draw(gl.TRIANGLES);
  }

  /// What is behind first, then what is in front.
  drawShape(matrices, opacity, zoom) {
    const gl = this.gl, isOpaque = opacity >= 0.995;
    gl.depthMask(isOpaque);
    if (!this.shape.hasIndices) {
      const size = Math.max(2, 2.2 * devicePixelRatio * Math.sqrt(zoom));
      this.programs.dots.use(matrices, {opacity, size});
      this.shape.draw(gl.POINTS);
    } else {
      this.programs.surface.use(matrices, {opacity});
      this.shape.draw(gl.TRIANGLES);
    }
    gl.depthMask(true);
  }
}
