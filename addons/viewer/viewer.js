// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

// What every page that draws a scene has: a camera, the mouse, fingers and keys that move it, and a
// panel beside it. A page's own script calls start().

/** Turns about a point that it looks at; rotation as a unit quaternion [w, x, y, z]. */
class Camera {
  constructor(radius) {
    this.radius = radius;
    this.fieldOfView = 0.52;
    this.reset();
  }

  reset() {
    // From the front and above, z up.
    this.rotation = [1, 0, 0, 0];
    this.turn([0, 0, 1], -0.6);
    this.turn([1, 0, 0], -1.2);
    this.distance = 0.88 * this.radius / Math.sin(this.fieldOfView / 2);
    this.offset = [0, 0];
  }

  /** By an angle about an axis of the screen: x right, y up, z to the eye. */
  turn(axis, angle) {
    const s = Math.sin(angle / 2), c = Math.cos(angle / 2);
    const [a, b] = [[c, s * axis[0], s * axis[1], s * axis[2]], this.rotation];
    const q = [a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
      a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
      a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
      a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]];
    const length = Math.hypot(...q);
    this.rotation = q.map((x) => x / length);
  }

  drag(dx, dy) {
    const length = Math.hypot(dx, dy);
    if (length > 0) this.turn([dy / length, dx / length, 0], 0.008 * length);
  }

  pan(dx, dy, height) {
    const scale = 2 * this.distance * Math.tan(this.fieldOfView / 2) / height;
    this.offset = [this.offset[0] + dx * scale, this.offset[1] - dy * scale];
  }

  zoom(factor) {
    this.distance = Math.min(Math.max(this.distance * factor, 0.02 * this.radius),
      60 * this.radius);
  }

  /** `covered`: the part of the height, from below, that controls hide: the scene is above it. */
  matrices(width, height, covered) {
    const [w, x, y, z] = this.rotation;
    const view = [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y), 0,
      2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x), 0,
      2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y), 0,
      this.offset[0], this.offset[1], -this.distance, 1];
    const near = Math.max(this.distance - 2 * this.radius, 0.01 * this.distance);
    const far = this.distance + 2 * this.radius;
    // The scene fits the shorter side of what is free.
    const slope = Math.tan(this.fieldOfView / 2) * Math.max(1 / (1 - covered), height / width);
    const f = 1 / slope, depth = near - far;
    const projection = [f * height / width, 0, 0, 0, 0, f, 0, 0,
      0, -covered, (far + near) / depth, -1, 0, 0, 2 * far * near / depth, 0];
    return {view, projection, pixel: 2 * slope / height};
  }
}

const byId = (id) => document.getElementById(id);
const content = JSON.parse(byId('scene').textContent);
const {scene} = content;
const canvas = byId('canvas');
const camera = new Camera(scene.radius);
/** What the renderer is told; a page's script adds to it. */
const shown = {level: 0, opacity: 0.45, ratio: 1, volumes: true, mesh: true, edges: false,
  segment: true};
let renderer = null;
let waiting = false;

function redraw() {
  if (waiting || !renderer) return;
  waiting = true;
  requestAnimationFrame(() => {
    waiting = false;
    shown.ratio = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.max(1, Math.round(canvas.clientWidth * shown.ratio));
    const height = Math.max(1, Math.round(canvas.clientHeight * shown.ratio));
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
    const covered = Math.min(0.5, byId('controls').offsetHeight / canvas.clientHeight);
    renderer.draw(camera.matrices(width, height, covered), shown);
    document.body.dataset.state = 'drawn';
  });
}

// The panel.

function add(parent, tag, text, className) {
  const element = document.createElement(tag);
  if (text !== undefined) element.textContent = text;
  if (className) element.className = className;
  parent.append(element);
  return element;
}

const count = (n) => n.toLocaleString('en');
const short = (x) => Number(x.toPrecision(5)).toString();
const percent = (x, digits = 1) => (100 * x).toFixed(digits) + ' %';
const bytes = (n) => n < 1e4 ? n + ' B' : n < 1e7 ? Math.round(n / 1e3) + ' kB' :
  (n / 1e6).toFixed(1) + ' MB';
const time = (s) => s < 1e-3 ? (1e6 * s).toFixed(1) + ' µs' : s < 1 ?
  (1e3 * s).toFixed(1) + ' ms' : s.toFixed(1) + ' s';

function list(parent, rows) {
  const element = add(parent, 'dl');
  for (const [name, value] of rows) {
    add(element, 'dt', name);
    add(element, 'dd', value);
  }
}

/** A line about keys and what they do. */
function describeKeys(panel, pairs) {
  const keys = add(panel, 'p', undefined, 'faint');
  for (const [key, what] of [['drag', 'turn'], ['wheel', 'zoom'], ['shift-drag', 'move'],
    ...pairs, ['arrows + −', 'turn, zoom'], ['R', 'reset']]) {
    add(keys, 'kbd', key);
    keys.append(' ' + what + '  ');
  }
}

// Controls.

/** A check box of each name sets shown[name]. */
function connectBoxes(names) {
  for (const name of names) {
    const box = byId('show-' + name);
    box.checked = shown[name];
    box.addEventListener('change', () => {
      shown[name] = box.checked;
      redraw();
    });
  }
  byId('reset').addEventListener('click', () => {
    camera.reset();
    redraw();
  });
  byId('controls').addEventListener('submit', (event) => event.preventDefault());
}

/** `more`: functions by key, beside those that move the camera. */
function connectKeys(more) {
  const keys = {
    ArrowLeft: () => camera.drag(-12, 0), ArrowRight: () => camera.drag(12, 0),
    ArrowUp: () => camera.drag(0, -12), ArrowDown: () => camera.drag(0, 12),
    '+': () => camera.zoom(0.9), '=': () => camera.zoom(0.9), '-': () => camera.zoom(1 / 0.9),
    r: () => camera.reset(), ...more};
  document.addEventListener('keydown', (event) => {
    const isSlider = event.target.type === 'range' && event.key.startsWith('Arrow');
    const action = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action || isSlider || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    action();
    redraw();
  });
}

/** One finger or the left button turns; two fingers, the right button or shift move; both zoom. */
function connectPointers() {
  const pointers = new Map();
  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
  });
  canvas.addEventListener('pointermove', (event) => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    const now = [event.clientX, event.clientY];
    const [dx, dy] = [now[0] - last[0], now[1] - last[1]];
    pointers.set(event.pointerId, now);
    if (pointers.size === 1) {
      const move = event.shiftKey || (event.buttons & 6) !== 0;
      if (move) camera.pan(dx, dy, canvas.clientHeight); else camera.drag(dx, dy);
    } else {
      const [, other] = [...pointers].find(([id]) => id !== event.pointerId);
      const gap = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]);
      if (gap(now) > 0) camera.zoom(gap(last) / gap(now));
      camera.pan(dx / 2, dy / 2, canvas.clientHeight);
    }
    redraw();
  });
  for (const end of ['pointerup', 'pointercancel']) {
    canvas.addEventListener(end, (event) => pointers.delete(event.pointerId));
  }
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 16 : 1;
    camera.zoom(Math.exp(0.0012 * lines * Math.max(-400, Math.min(400, event.deltaY))));
    redraw();
  }, {passive: false});
}

/** Draws the scene; `connect` sets up the page's own controls once there is a picture. */
function start(connect) {
  try {
    renderer = new Renderer(canvas, scene);
    connect();
    connectPointers();
    redraw();
    new ResizeObserver(redraw).observe(canvas);
  } catch (error) {
    byId('failure').textContent = error.message;
    byId('failure').hidden = false;
    byId('controls').hidden = true;
    document.body.dataset.state = 'failed';
  }
}
