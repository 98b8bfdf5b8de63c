// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

const {report} = content;
shown.level = scene.level;
if (report.pair) shown.opacity = 0.25;

// Statistics.

function describePair(panel, pair) {
  const point = (p) => '(' + p.map(short).join(', ') + ')';
  add(panel, 'h2', 'Distance');
  add(panel, 'p', short(pair.distance), 'big');
  if (pair.distance === 0) add(panel, 'p', 'The meshes touch or intersect.', 'faint');
  list(panel, [
    ['nearest on A', point(pair.point_a) + ', triangle ' + pair.triangle_a],
    ['nearest on B', point(pair.point_b) + ', triangle ' + pair.triangle_b],
    ['time', time(pair.median_us / 1e6) + ', median of ' + pair.repeats + ', ' +
      pair.simd_target]]);
}

function describeMesh(panel, mesh, index, names) {
  const title = add(panel, 'h2', (names.length > 1 ? 'AB'[index] + ': ' + names[index] : 'Mesh') + ' ');
  add(title, 'span', '', 'swatch').style.background = `rgb(${scene.meshes[index].color.join()})`;
  for (const warning of mesh.warnings) add(panel, 'p', warning, 'warning');
  const sizes = mesh.box.upper.map((u, i) => short(u - mesh.box.lower[i])).join(' × ');
  list(panel, [
    ['triangles', `${count(mesh.triangles)}, ${mesh.surface}`],
    ['vertices', `${count(mesh.distinct_vertices)} distinct of ${count(mesh.vertices)}`],
    ['box', sizes],
    ['nodes', `${count(mesh.nodes)} in ${mesh.depth + 1} levels`],
    ['spheres', `k = 1: ${count(mesh.k[1])}, 3: ${count(mesh.k[3])}, 5: ${count(mesh.k[5])}`],
    ['memory', `${bytes(mesh.model_bytes)} + ${bytes(mesh.prepared_bytes)} prepared, ` +
      Math.round((mesh.model_bytes + mesh.prepared_bytes) / mesh.triangles) + ' B a triangle'],
    ['time', `build ${time(mesh.build_seconds)}`]]);
  if (mesh.levels.length === 0) return;
  const table = add(panel, 'table');
  table.style.marginTop = '12px';
  const head = add(add(table, 'thead'), 'tr');
  for (const [name, tip] of [['level', ''], ['volumes', ''], ['k = 5', 'volumes of five spheres'],
    ['size', 'mean size of the contents'], ['slack', 'mean reach of a volume beyond its content, ' +
      'in parts of the content’s size'], ['S0', 'slack of sphere S0 alone']]) {
    add(head, 'th', name).title = tip;
  }
  const body = add(table, 'tbody');
  for (const level of mesh.levels) {
    const row = add(body, 'tr');
    row.dataset.level = level.level;
    for (const cell of [level.level, count(level.volumes), percent(level.k[5] / level.volumes, 0),
      Number(level.content_size.toPrecision(3)), percent(level.slack_mean),
      percent(level.slack_mean_s0)]) {
      add(row, 'td', cell);
    }
    if (level.level < scene.meshes[index].levels.length) {
      row.className = 'shown';
      row.addEventListener('click', () => chooseLevel(level.level));
    }
  }
}

function describe() {
  const panel = byId('panel');
  const names = report.meshes.map((mesh) => mesh.file.split(/[\\/]/).pop());
  document.title = names.join(' and ') + ' · kios_inspect';
  add(panel, 'h1', names.join(' and '));
  for (const note of content.notes) add(panel, 'p', note, 'faint');
  if (report.pair) describePair(panel, report.pair);
  report.meshes.forEach((mesh, i) => describeMesh(panel, mesh, i, names));
  add(panel, 'p', 'Lengths are in the file’s units. A volume is an intersection of k spheres around a ' +
    'part of the mesh; colours tell neighbours apart.' + (report.meshes.some((mesh) =>
      Object.values(mesh.self_intersections).some((n) => n > 0 && n !== true)) ?
      ' Red: triangles that meet others beyond what they share.' : ''), 'faint');
  if (report.meshes.some((mesh) => mesh.levels.length > 0)) {
    add(panel, 'p', 'Slack: how far volumes reach beyond their contents, in parts of the ' +
      'contents’ size, mean over directions. A distance bound is too low by about that much. ' +
      'S0: the same for the central sphere alone.', 'faint').style.marginTop = '10px';
  }
  describeKeys(panel, [['[ ]', 'level'], ['V M E', 'what is shown']]);
}

// Controls.

function chooseLevel(level) {
  const slider = byId('level');
  shown.level = Math.min(Math.max(level, 0), Number(slider.max));
  slider.value = shown.level;
  const volumes = scene.meshes.map(
    ({volumes}) => count(volumes[Math.min(shown.level, volumes.length - 1)]));
  byId('level-name').textContent = `level ${shown.level}: ${volumes.join(' + ')} volumes`;
  for (const row of document.querySelectorAll('tr[data-level]')) {
    row.classList.toggle('chosen', Number(row.dataset.level) === shown.level);
  }
  redraw();
}

function connectControls() {
  byId('level').max = Math.max(...scene.meshes.map((mesh) => mesh.levels.length)) - 1;
  byId('level').addEventListener('input', (event) => chooseLevel(Number(event.target.value)));
  byId('opacity').value = shown.opacity;
  byId('opacity').addEventListener('input', (event) => {
    shown.opacity = Number(event.target.value);
    redraw();
  });
  connectBoxes(['volumes', 'mesh', 'edges']);
  connectKeys({
    '[': () => chooseLevel(shown.level - 1), ']': () => chooseLevel(shown.level + 1),
    v: () => byId('show-volumes').click(), m: () => byId('show-mesh').click(),
    e: () => byId('show-edges').click()});
  chooseLevel(scene.level);
}

describe();
start(connectControls);
