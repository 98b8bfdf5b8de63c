// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

const {frames, motion, stops} = content;
Object.assign(shown, {volumes: false, robot: true, obstacles: true, stops: true, place: 0});
const CONTACT = [222, 84, 72];
const NEAREST = [0.1, 0.35, 0.85];
const fields = {};

const ghosts = [];  // the robot at each stop of the path

// The first of the path's places that is in contact, or can't be told; -1 if there is none.
const contactPlace = motion && motion.pair ?
  frames.findIndex((frame) => frame.at === motion.to) : -1;

// The panel.

function describe() {
  const panel = byId('panel');
  document.title = content.title + ' · kios_robot';
  add(panel, 'h1', content.title);
  for (const note of content.notes) add(panel, 'p', note, 'faint');
  if (motion) {
    add(panel, 'h2', 'Motion');
    if (motion.verdict === 'clear') {
      add(panel, 'p', 'clear', 'big');
      add(panel, 'p', 'Proven for every configuration of the path.', 'faint');
    } else {
      const where = `${(100 * motion.to).toFixed(3)} %`;
      add(panel, 'p', motion.verdict, 'big');
      add(panel, 'p', `${motion.pair.join(' and ')}, at ${where} of the path` +
        (motion.verdict === 'contact' ? ', the first contact' : '') + '.', 'warning');
    }
  }
  add(panel, 'h2', 'Clearance');
  fields.clearance = add(panel, 'p', '', 'big');
  fields.pair = add(panel, 'p', '');
  const near = frames.filter((frame) => frame.nearest);
  if (near.length > 1) {
    const least = near.reduce((a, b) => (b.contact ? 0 : b.clearance) < (a.contact ? 0 : a.clearance) ? b : a);
    add(panel, 'p', 'Least of the places of the slider: ' +
      (least.contact ? 'contact' : short(least.clearance) + ' m') + `, at ${(100 * least.at).toFixed(1)} %.`, 'faint');
  }
  if (content.band.some((step) => step[0] !== null)) addCurve(panel);
  add(panel, 'p', 'Blue: the nearest points. Red: what is in contact.', 'faint');
  add(panel, 'h2', 'Coordinates');
  const rows = add(panel, 'dl');
  fields.coordinates = content.joints.map((joint) => {
    add(rows, 'dt', joint);
    return add(rows, 'dd', '');
  });
  describeKeys(panel, [['[ ]', 'along the path'], ['C', 'first contact'],
    ['M O N E S', 'what is shown']]);
}

// The band of the least clearance, of which each step of the slider has a proven bracket.

const WIDTH = 240, HEIGHT = 90;

function addCurve(panel) {
  const {band} = content, known = band.flat().filter((x) => x !== null);
  const most = Math.max(...known, 0), least = Math.min(...known, 0), span = most - least || 1;
  const x = (i) => WIDTH * frames[i].at;
  const y = (d) => HEIGHT * (1 - ((d === null ? most : d) - least) / span);
  // Along the upper ends of all steps, and back along the lower ones.
  const corners = band.flatMap((b, i) => [[x(i), y(b[1])], [x(i + 1), y(b[1])]]).concat(
    band.flatMap((b, i) => [[x(i), y(b[0])], [x(i + 1), y(b[0])]]).reverse());
  const picture = add(panel, 'div', undefined, 'curve');
  picture.innerHTML = `<svg viewBox="0 -2 ${WIDTH} ${HEIGHT + 4}" role="img"
    aria-label="The proven band of the least clearance along the path">
    <line class="axis" x1="0" y1="${y(0)}" x2="${WIDTH}" y2="${y(0)}"/>
    <path class="band" d="M${corners.map((c) => c.map((v) => v.toFixed(2)).join(' ')).join('L')}Z"/>
    <line class="place" y1="0" y2="${HEIGHT}"/></svg>`;
  fields.place = picture.querySelector('.place');
  picture.addEventListener('click', (event) => {
    const box = picture.firstElementChild.getBoundingClientRect();
    const at = (event.clientX - box.left) / box.width;
    choosePlace(frames.reduce((best, frame, i) =>
      Math.abs(frame.at - at) < Math.abs(frames[best].at - at) ? i : best, 0));
  });
  const low = Math.min(...band.map((b) => b[0] === null ? Infinity : b[0]));
  add(panel, 'p', `Proven for each step of the slider, up to ${short(most)} m` +
    (low > 0 ? `; nothing is nearer than ${short(low)} m all along.` : '.'), 'faint');
}

// Controls.

const posesAt = (place) => {
  const poses = decode(frames[place].poses, Float32Array);
  return (mesh) => Array.from(poses.subarray(16 * mesh, 16 * mesh + 16));
};

function addGhosts() {
  const OPACITY = 0.3;
  for (const place of stops) {
    const poseOf = posesAt(place);
    renderer.meshes.slice(0, scene.meshes.length).forEach((mesh, i) => {
      if (scene.meshes[i].obstacle) return;
      ghosts.push({...mesh, matrix: poseOf(i), opacity: OPACITY, levels: []});
    });
  }
  renderer.meshes.push(...ghosts);
}

function choosePlace(place) {
  shown.place = Math.min(Math.max(place, 0), frames.length - 1);
  const frame = frames[shown.place];
  byId('path').value = shown.place;
  if (fields.place) {
    for (const end of ['x1', 'x2']) fields.place.setAttribute(end, WIDTH * frame.at);
  }
  byId('path-name').textContent = `${(100 * frame.at).toFixed(1)} % of the path`;
  const poseOf = posesAt(shown.place);
  scene.meshes.forEach((mesh, i) => {
    const touches = frame.contact && frame.nearest && frame.nearest.includes(mesh.name);
    const drawn = renderer.meshes[i];
    drawn.matrix = poseOf(i);
    drawn.color = (touches ? CONTACT : mesh.color).map((c) => c / 255);
    drawn.hidden = mesh.obstacle ? !shown.obstacles : !shown.robot;
  });
  for (const ghost of ghosts) ghost.hidden = !shown.robot || !shown.stops;
  scene.segment = frame.segment || null;
  scene.segmentColor = frame.contact ? null : NEAREST;
  fields.clearance.textContent = frame.contact ? 'contact' :
    frame.nearest ? short(frame.clearance) + ' m' : 'no pair is checked';
  fields.pair.textContent = frame.nearest ? frame.nearest.join(' and ') : '';
  fields.coordinates.forEach((field, i) => {
    field.textContent = short(frame.q[i]);
  });
  redraw();
}

function connectControls() {
  const slider = byId('path'), update = () => choosePlace(shown.place);
  slider.max = frames.length - 1;
  slider.addEventListener('input', () => choosePlace(Number(slider.value)));
  byId('path-row').hidden = frames.length === 1;
  if (contactPlace >= 0) {
    const first = byId('first');
    first.hidden = byId('mark').hidden = false;
    byId('mark').style.setProperty('--place', contactPlace / (frames.length - 1));
    first.addEventListener('click', () => choosePlace(contactPlace));
  }
  addGhosts();
  byId('stops-label').hidden = stops.length === 0;
  connectBoxes(['obstacles', 'segment', 'edges', 'stops']);
  byId('show-mesh').addEventListener('change', (event) => {
    shown.robot = event.target.checked;
    update();
  });
  byId('show-obstacles').addEventListener('change', update);
  byId('show-stops').addEventListener('change', update);
  connectKeys({
    '[': () => choosePlace(shown.place - 1), ']': () => choosePlace(shown.place + 1),
    c: () => contactPlace >= 0 && choosePlace(contactPlace),
    m: () => byId('show-mesh').click(), o: () => byId('show-obstacles').click(),
    n: () => byId('show-segment').click(), e: () => byId('show-edges').click(),
    s: () => byId('show-stops').click()});
  choosePlace(Math.max(contactPlace, 0));
}

describe();
start(connectControls);
