// What people turn, press and read.
const kDrag = 0.008, kKeyTurn = 0.12, kKeyMove = 0.08, kKeyZoom = 1.15;

function element(id) { return document.getElementById(id); }

/// To four figures, as short as they come.
function figure(number) {
  return String(Number(number.toPrecision(4)));
}

function showFacts(facts) {
  for (const [name, value] of facts) {
    const term = document.createElement("dt"), text = document.createElement("dd");
    term.textContent = name, text.textContent = value;
    element("facts").append(term, text);
  }
}

function showLayers(lines) {
  lines.forEach((layer, i) => {
    const label = document.createElement("label"), box = document.createElement("input");
    const swatch = document.createElement("span"), count = document.createElement("small");
    box.type = "checkbox", box.className = "layer", box.checked = i === 0;
    swatch.className = "swatch";
    count.textContent = layer.radii.length, count.title = "nodes";
    label.append(box, swatch, layer.name, count);
    element("layers").append(label);
  });
}

/// The scale of radii, in the units of the file.
function showScale({lines, unit}, {byRadius, colours}) {
  const scale = element("scale");
  if (!lines[0] || lines[0].radii.length === 0) return;
  scale.hidden = !byRadius;
  const [thin, thick] = rangeOf(lines[0].radii).map(r => figure(r * unit));
  element("thin").textContent = "radius " + thin;
  element("thick").textContent = thick + " (units of the file)";
  element("bar").style.background = `linear-gradient(90deg, ${colours.radii.map(c => `rgb(${c})`).join(",")})`;
}

/// `stages` and `radii` are lists of colours; those of radii are made to stand out from dark too.
function readColours(stages, radii, isDark) {
  const style = getComputedStyle(document.documentElement);
  const colour = name => {
    const text = style.getPropertyValue(name).trim();
    return colourOf(text.length === 7 ? text : "#808080");
  };
  return {paper: colour("--paper"), surface: colour("--surface"), joint: colour("--joint"),
          tip: colour("--tip"), stages: stages.map(colourOf),
          radii: radii.map(colourOf).map(c => isDark ? c.map(v => 0.62 * v + 97) : c)};
}

function chosen(name) {
  return document.querySelector(`input[name=${name}]:checked`).value;
}

/// The next choice of a group of radio buttons.
function chooseNext(name) {
  const all = [...document.querySelectorAll(`input[name=${name}]`)];
  all[(all.findIndex(input => input.checked) + 1) % all.length].checked = true;
}

function readShown() {
  return {surface: element("surface").checked, opacity: element("opacity").value / 100,
          balls: chosen("balls"),
          lines: [...document.querySelectorAll(".layer")].map(box => box.checked)};
}

/// One pointer turns (or moves, with Shift or another button), two move and zoom.
function listenToPointers(canvas, camera, redraw, click) {
  const pointers = new Map();
  let travelled = 0;
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return {middle: [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2], far: Math.hypot(a[0] - b[0], a[1] - b[1]) || 1};
  };
  const moveBy = (dx, dy) => camera.move(2 * dx / canvas.clientHeight, -2 * dy / canvas.clientHeight);
  canvas.addEventListener("pointerdown", event => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
    travelled = 0;
  });
  canvas.addEventListener("pointermove", event => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    const before = pointers.size === 2 ? spread() : null;
    const now = [event.clientX, event.clientY], dx = now[0] - last[0], dy = now[1] - last[1];
    pointers.set(event.pointerId, now);
    travelled += Math.hypot(dx, dy);
    if (before) {
      const after = spread();
      moveBy(after.middle[0] - before.middle[0], after.middle[1] - before.middle[1]);
      camera.scale(after.far / before.far);
    } else if (event.shiftKey || event.buttons > 1) moveBy(dx, dy);
    else camera.rotate(dx * kDrag, dy * kDrag);
    redraw();
  });
  for (const type of ["pointerup", "pointercancel"])
    canvas.addEventListener(type, event => {
      if (type === "pointerup" && pointers.size === 1 && travelled < 5) click(event);
      pointers.delete(event.pointerId);
    });
  canvas.addEventListener("contextmenu", event => event.preventDefault());
  canvas.addEventListener("wheel", event => {
    event.preventDefault();
    camera.scale(Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.0015)));
    redraw();
  }, {passive: false});
}

/// Keys work wherever the focus is, but for arrows in a control, which need them themselves.
function listenToKeys(camera, redraw, repaint) {
  const steps = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
  const actions = {
    "+": () => camera.scale(kKeyZoom), "=": () => camera.scale(kKeyZoom),
    "-": () => camera.scale(1 / kKeyZoom), "_": () => camera.scale(1 / kKeyZoom),
    r: () => camera.reset(), f: () => element("surface").click(), s: () => chooseNext("balls"),
    c: () => { chooseNext("colour"); repaint(); },
    l: () => showNextLayer(),
  };
  addEventListener("keydown", event => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const step = steps[event.key], action = actions[event.key.toLowerCase()];
    if (step && event.target instanceof HTMLInputElement) return;
    if (step && event.shiftKey) camera.move(kKeyMove * step[0], kKeyMove * step[1]);
    else if (step) camera.rotate(kKeyTurn * step[0], -kKeyTurn * step[1]);
    else if (action) action();
    else return;
    event.preventDefault();
    redraw();
  });
}

/// One layer alone, the one behind the first that is shown.
function showNextLayer() {
  const boxes = [...document.querySelectorAll(".layer")];
  if (boxes.length === 0) return;
  const next = (boxes.findIndex(box => box.checked) + 1) % boxes.length;
  boxes.forEach((box, i) => { box.checked = i === next; });
}
