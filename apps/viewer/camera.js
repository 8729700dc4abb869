// A camera that turns around the shape in any direction. Matrices are columns, as WebGL has them.
const kHalfAngle = 15 * Math.PI / 180;
const kFit = 0.88;  // few shapes fill their half-diagonal, which is 1

function multiplyTurns([a, b, c, d], [e, f, g, h]) {
  return [a * e - b * f - c * g - d * h, a * f + b * e + c * h - d * g,
          a * g - b * h + c * e + d * f, a * h + b * g - c * f + d * e];
}

function turnAround([x, y, z], angle) {
  const s = Math.sin(angle / 2);
  return [Math.cos(angle / 2), x * s, y * s, z * s];
}

/// Rows right, up, toward of a turn.
function axesOf([w, x, y, z]) {
  return [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
          [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
          [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]];
}

class Camera {
  constructor() { this.reset(); }

  /// From the front, a little from above and aside.
  reset() {
    this.turn = multiplyTurns(turnAround([1, 0, 0], 0.35), turnAround([0, 1, 0], -0.5));
    this.zoom = 1;
    this.offset = [0, 0];
  }

  rotate(right, up) {
    const turn = multiplyTurns(multiplyTurns(turnAround([0, 1, 0], right),
                                             turnAround([1, 0, 0], up)), this.turn);
    const length = Math.hypot(...turn);
    this.turn = turn.map(c => c / length);
  }

  /// In units of the half height of the picture.
  move(right, up) {
    const reach = kFit / this.zoom;
    this.offset = [this.offset[0] + right * reach, this.offset[1] + up * reach]
      .map(o => Math.min(Math.max(o, -3), 3));
  }

  scale(factor) { this.zoom = Math.min(Math.max(this.zoom * factor, 0.2), 60); }

  /// {view, projection, eye}: eye in the space of the shape.
  matrices(aspect) {
    const fit = aspect < 1 ? kFit / aspect : kFit;
    const away = fit / Math.tan(kHalfAngle) / this.zoom;
    const axes = axesOf(this.turn);
    const view = [];
    for (let column = 0; column < 3; ++column)
      view.push(axes[0][column], axes[1][column], axes[2][column], 0);
    view.push(this.offset[0], this.offset[1], -away, 1);
    const near = Math.max(away - 4, away * 0.02), far = away + 4, f = 1 / Math.tan(kHalfAngle);
    const projection = [f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1,
                        0, 0, 2 * far * near / (near - far), 0];
    const inView = [-this.offset[0], -this.offset[1], away];
    const eye = [0, 1, 2].map(k => axes[0][k] * inView[0] + axes[1][k] * inView[1] +
                                   axes[2][k] * inView[2]);
    return {view, projection, eye};
  }
}

/// Where a point is on the picture, both from -1 to 1, and its distance; null behind the camera.
function project({view, projection}, x, y, z) {
  const at = [0, 1, 2].map(k => view[k] * x + view[4 + k] * y + view[8 + k] * z + view[12 + k]);
  if (at[2] >= 0) return null;
  return [-at[0] * projection[0] / at[2], -at[1] * projection[5] / at[2], -at[2]];
}
