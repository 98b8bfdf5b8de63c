// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

const {report, order} = content;
Object.assign(shown, {volumes: false, others: true, clash: -1});
const COLORS = [[222, 84, 72], [64, 120, 200]];  // of a and b
const PLAIN = [[208, 213, 220], [170, 184, 204]];
const FAINT = 0.12;
const MOST_ROWS = 5000;
const placeOf = new Map(report.parts.map((part, i) => [part.name, i]));

scene.meshes.forEach((mesh, i) => {
  Object.assign(mesh, content.geometries[mesh.geometry], {levels: [], color: PLAIN[i % 2]});
});

// The panel.

function measureOf(clash) {
  const [lower, upper] = (clash.depth || clash.distance).map(
    (x) => x === null ? 'more' : Number(x.toPrecision(3)).toString());
  const between = upper === 'more' ? ' or ' : ' to ';
  return lower + (upper === lower ? '' : between + upper) + (clash.depth ? ' deep' : ' apart');
}

function addTable(panel) {
  const table = add(panel, 'table');
  const head = add(add(table, 'thead'), 'tr');
  for (const name of ['clash', 'a and b', 'measure']) add(head, 'th', name);
  const body = add(table, 'tbody');
  for (const index of order.slice(0, MOST_ROWS)) {
    const clash = report.clashes[index], row = add(body, 'tr', undefined, 'shown');
    row.dataset.clash = index;
    add(row, 'td', clash.status + (clash.decided ? '' : ' ?'));
    const names = add(row, 'td', clash.a + ' and ' + clash.b);
    Object.assign(names.style, {textAlign: 'left', overflowWrap: 'anywhere'});
    add(row, 'td', measureOf(clash));
    row.addEventListener('click', () => chooseClash(index));
  }
}

function describe() {
  const panel = byId('panel');
  document.title = 'Clashes · kios_clash';
  add(panel, 'h1', `${count(report.clashes.length)} clashes of ${count(report.parts.length)} parts`);
  list(panel, Object.entries(report.counts).map(([status, n]) => [status, count(n)]).concat(
    [['touch up to', short(report.touch)], ['clearance', short(report.clearance)]]));
  for (const error of report.errors) add(panel, 'p', error, 'warning');
  const open = report.parts.filter((part) => !part.solid).length;
  if (open > 0) add(panel, 'p', `${count(open)} parts are surfaces without an inside.`, 'warning');
  const flat = report.parts.filter((part) => part.flat).length;
  if (flat > 0) add(panel, 'p', `${count(flat)} parts have no volume.`, 'warning');
  if (content.left_out > 0) {
    add(panel, 'p', `${count(content.left_out)} parts aren’t drawn: see --html-limit.`, 'warning');
  }
  add(panel, 'p', 'A click shows a clash, a red and b blue. “?”: not decided.', 'faint');
  addTable(panel);
  if (order.length > MOST_ROWS) add(panel, 'p', `The first ${count(MOST_ROWS)} are listed.`, 'faint');
  describeKeys(panel, [['[ ]', 'clash'], ['A', 'all parts'], ['O E', 'what is shown']]);
}

// Controls.

/** Looks at a clash, from as far as its smaller part needs; at all parts for -1. */
function chooseClash(index) {
  shown.clash = index;
  const clash = report.clashes[index];
  const pair = clash ? [placeOf.get(clash.a), placeOf.get(clash.b)] : [];
  const smaller = pair.reduce((i, j) => scene.meshes[j].size < scene.meshes[i].size ? j : i, pair[0]);
  const segment = clash ? content.segments[index] : null;
  const focus = segment ? segment[0].map((x, i) => (x + segment[1][i]) / 2) : [0, 0, 0];
  scene.meshes.forEach((mesh, i) => {
    const drawn = renderer.meshes[i], which = pair.indexOf(i);
    drawn.matrix = mesh.matrix.map((x, k) => k >= 12 && k < 15 ? x - focus[k - 12] : x);
    drawn.color = (which < 0 ? mesh.color : COLORS[which]).map((c) => c / 255);
    drawn.opacity = !clash || i === smaller ? 1 : which < 0 ? FAINT : 0.7;
    drawn.hidden = which < 0 && clash !== undefined && !shown.others;
  });
  scene.segment = segment && segment.map((p) => p.map((x, i) => x - focus[i]));
  camera.offset = [0, 0];
  camera.distance = (clash ? Math.max(scene.meshes[smaller].size, 1e-4) : 0.88 * camera.radius) /
    Math.sin(camera.fieldOfView / 2);
  for (const row of document.querySelectorAll('tr[data-clash]')) {
    row.classList.toggle('chosen', Number(row.dataset.clash) === index);
  }
  redraw();
}

function step(by) {
  const listed = order.slice(0, MOST_ROWS), at = listed.indexOf(shown.clash);
  const next = at < 0 ? 0 : Math.min(Math.max(at + by, 0), listed.length - 1);
  if (listed.length === 0) return;
  chooseClash(listed[next]);
  document.querySelector('tr.chosen').scrollIntoView({block: 'nearest'});
}

function connectControls() {
  connectBoxes(['others', 'segment', 'edges']);
  byId('show-others').addEventListener('change', () => chooseClash(shown.clash));
  byId('all').addEventListener('click', () => chooseClash(-1));
  connectKeys({'[': () => step(-1), ']': () => step(1), a: () => chooseClash(-1),
    o: () => byId('show-others').click(), e: () => byId('show-edges').click()});
  chooseClash(-1);
}

describe();
start(connectControls);
