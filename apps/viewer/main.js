// Puts the page together.
const kStages = ["#c2485d", "#b07d12", "#2c8f6f", "#3f77c9", "#8a5cc4", "#6b7686"];
const kClickReach = 14;  // pixels

const data = readData();
const canvas = element("view"), camera = new Camera();
const darkness = matchMedia("(prefers-color-scheme: dark)");
let scene = null, matrices = null, isAsked = false;

showFacts(data.facts);
showLayers(data.lines);
if (matchMedia("(max-width: 640px)").matches) element("panel").open = false;

function look() {
  const byBranch = chosen("colour") === "branch";
  return {byBranch, byRadius: !byBranch,
          colours: readColours(kStages, data.radiusColours, darkness.matches)};
}

function draw() {
  isAsked = false;
  if (!scene || scene.gl.isContextLost()) return;
  const ratio = Math.min(devicePixelRatio || 1, 2);
  canvas.width = Math.max(1, Math.round(canvas.clientWidth * ratio));
  canvas.height = Math.max(1, Math.round(canvas.clientHeight * ratio));
  matrices = scene.draw(camera, readShown());
  document.documentElement.dataset.drawn = String(Number(document.documentElement.dataset.drawn || 0) + 1);
}

function redraw() {
  if (isAsked) return;
  isAsked = true;
  requestAnimationFrame(draw);
}

function repaint() {
  const now = look();
  showScale(data, now);
  [...document.querySelectorAll(".swatch")].forEach((swatch, i) => {
    const own = data.palette[0] || kStages[0];
    swatch.style.background = i > 0 ? kStages[(i - 1) % kStages.length] : own;
  });
  if (scene) scene.paint(now);
  redraw();
}

/// The node of the shown lines that is nearest to a click.
function nearestNode(event) {
  const shown = readShown().lines;
  let best = null, least = kClickReach;
  data.lines.forEach(({positions, radii}, layer) => {
    if (!shown[layer]) return;
    for (let n = 0; n < radii.length; ++n) {
      const at = project(matrices, positions[3 * n], positions[3 * n + 1], positions[3 * n + 2]);
      if (!at) continue;
      const x = (at[0] + 1) / 2 * canvas.clientWidth, y = (1 - at[1]) / 2 * canvas.clientHeight;
      const far = Math.hypot(x - event.clientX, y - event.clientY);
      if (far < least) least = far, best = {layer, node: n};
    }
  });
  return best;
}

function tellNode(event) {
  const found = matrices && nearestNode(event);
  if (!found) { element("status").textContent = ""; return; }
  const {name, edges, branches, radii} = data.lines[found.layer];
  const edge = edges.indexOf(found.node);
  const branch = edge < 0 || found.layer > 0 ? "" : `, branch ${branches[edge >> 1]}`;
  element("status").textContent =
    `${name}: node ${found.node}${branch}, radius ${figure(radii[found.node] * data.unit)}`;
}

function start() {
  try {
    scene = new Scene(canvas, data, look());
  } catch (error) {
    scene = null;
    element("sorry").hidden = false;
  }
  repaint();
}

listenToPointers(canvas, camera, redraw, tellNode);
listenToKeys(camera, redraw, repaint);
canvas.addEventListener("webglcontextlost", event => event.preventDefault());
canvas.addEventListener("webglcontextrestored", start);
element("choices").addEventListener("input", event => event.target.name === "colour" ? repaint() : redraw());
element("choices").addEventListener("submit", event => event.preventDefault());
element("reset").addEventListener("click", () => { camera.reset(); redraw(); });
darkness.addEventListener("change", repaint);
addEventListener("resize", redraw);
start();
