// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
'use strict';

// Volumes are not triangulated: each is the back of a box, whose fragments solve for where their
// ray enters all of its spheres. A sphere is f(x) = kappa/2 |x|^2 - u.x + h <= 0 about the middle
// of its box, with kappa = 1/r and u = c/r: no digits are lost where r is large.
const VOLUME_VERTEX = `#version 300 es
precision highp float;
layout(location = 0) in vec3 corner;
layout(location = 1) in vec4 middleColor;
layout(location = 2) in vec4 halfKappa;
layout(location = 3) in vec4 kappas;
layout(location = 4) in vec4 s0;
layout(location = 5) in vec4 s1;
layout(location = 6) in vec4 s2;
layout(location = 7) in vec4 s3;
layout(location = 8) in vec4 s4;
uniform mat4 toClip;
flat out vec4 sphere[5];
flat out float kappa[5];
flat out vec3 middle, color;
out vec3 local;
void main() {
  sphere = vec4[5](s0, s1, s2, s3, s4);
  kappa = float[5](halfKappa.w, kappas.x, kappas.y, kappas.z, kappas.w);
  middle = middleColor.xyz;
  float packed = middleColor.w;
  color = vec3(floor(packed / 65536.0), mod(floor(packed / 256.0), 256.0), mod(packed, 256.0));
  color /= 255.0;
  local = corner * halfKappa.xyz * 1.002;
  gl_Position = toClip * vec4(middle + local, 1.0);
}`;

const VOLUME_FRAGMENT = `#version 300 es
precision highp float;
flat in vec4 sphere[5];
flat in float kappa[5];
flat in vec3 middle, color;
in vec3 local;
uniform mat4 toClip;
uniform mat3 toView;
uniform vec3 eye;
uniform float pixel, opacity;
out vec4 result;
void main() {
  vec3 ray = local - (eye - middle);
  float toEye = length(ray);
  ray /= toEye;
  float enter = -1e30, leave = 1e30;
  int first = 0;
  for (int i = 0; i < 5; ++i) {
    float a = 0.5 * kappa[i];
    float b = kappa[i] * dot(local, ray) - dot(sphere[i].xyz, ray);
    float c = a * dot(local, local) - dot(sphere[i].xyz, local) + sphere[i].w;
    float d = b * b - 4.0 * a * c;
    if (d < 0.0) discard;
    float q = -0.5 * (b + (b < 0.0 ? -sqrt(d) : sqrt(d)));
    float t0 = q / a, t1 = q == 0.0 ? 0.0 : c / q;
    if (min(t0, t1) > enter) { enter = min(t0, t1); first = i; }
    leave = min(leave, max(t0, t1));
  }
  if (enter >= leave || enter < -toEye) discard;
  vec3 hit = local + enter * ray;
  vec4 clip = toClip * vec4(middle + hit, 1.0);
  gl_FragDepth = 0.5 * clip.z / clip.w + 0.5;

  vec3 normal = vec3(0.0);
  for (int i = 0; i < 5; ++i) {
    if (i == first) normal = normalize(kappa[i] * hit - sphere[i].xyz);
  }
  // How many pixels it is to the nearest crease.
  float crease = 1e9;
  for (int i = 0; i < 5; ++i) {
    vec3 other = kappa[i] * hit - sphere[i].xyz;
    float inside = dot(sphere[i].xyz, hit) - 0.5 * kappa[i] * dot(hit, hit) - sphere[i].w;
    float across = length(cross(other, normal));
    if (i != first && across > 0.02) crease = min(crease, max(inside, 0.0) / across);
  }
  crease /= pixel * clip.w;
  vec3 n = toView * normal;
  float facing = max(-dot(normal, ray), 0.0);
  float light = 0.42 + 0.50 * max(dot(n, normalize(vec3(0.35, 0.55, 0.75))), 0.0) + 0.12 * n.y;
  float edge = 1.0 - smoothstep(0.6, 1.6, crease);
  vec3 lit = mix(color * light, color * 0.35, 0.55 * edge);
  float alpha = mix(opacity, 1.0, 0.55 * pow(1.0 - facing, 3.0));
  result = vec4(lit, max(alpha, mix(0.0, 0.6, edge * step(0.01, opacity))));
}`;

const MESH_VERTEX = `#version 300 es
precision highp float;
layout(location = 0) in vec3 position;
uniform mat4 toClip, toView;
out vec3 seen;
void main() {
  seen = (toView * vec4(position, 1.0)).xyz;
  gl_Position = toClip * vec4(position, 1.0);
}`;

const MESH_FRAGMENT = `#version 300 es
precision highp float;
in vec3 seen;
uniform vec4 color;
uniform bool flatColor;
out vec4 result;
void main() {
  vec3 n = normalize(cross(dFdx(seen), dFdy(seen)));
  float light = 0.38 + 0.52 * max(dot(n, normalize(vec3(0.35, 0.55, 0.75))), 0.0) + 0.12 * n.y;
  result = flatColor ? color : vec4(color.rgb * light, color.a);
}`;

// The witness segment: a ribbon and two dots of constant width in pixels, over everything.
const SEGMENT_VERTEX = `#version 300 es
precision highp float;
layout(location = 0) in vec2 place;
uniform mat4 toClip;
uniform vec3 from, to;
uniform vec2 size;
uniform float width;
void main() {
  vec4 p = toClip * vec4(from, 1.0), q = toClip * vec4(to, 1.0);
  vec2 along = (q.xy / q.w - p.xy / p.w) * size;
  along = length(along) > 0.0 ? normalize(along) : vec2(1.0, 0.0);
  gl_Position = mix(p, q, place.x);
  gl_Position.xy += place.y * width * vec2(-along.y, along.x) / size * gl_Position.w;
  gl_PointSize = 6.0 * width;
}`;

const SEGMENT_FRAGMENT = `#version 300 es
precision highp float;
uniform vec4 color;
uniform bool dot;
out vec4 result;
void main() {
  if (dot && length(gl_PointCoord - 0.5) > 0.5) discard;
  result = color;
}`;

const RED = [0.86, 0.1, 0.16];

function decode(text, Type) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  return new Type(bytes.buffer);
}

/** Draws the page's scene into a canvas. Throws an Error if there is no WebGL 2. */
class Renderer {
  constructor(canvas, scene) {
    const gl = canvas.getContext('webgl2', {antialias: true, preserveDrawingBuffer: true});
    if (!gl) throw new Error('This browser offers no WebGL 2, so the picture can’t be drawn.');
    this.gl = gl;
    this.scene = scene;
    this.volumeProgram = this.link(VOLUME_VERTEX, VOLUME_FRAGMENT);
    this.meshProgram = this.link(MESH_VERTEX, MESH_FRAGMENT);
    this.segmentProgram = this.link(SEGMENT_VERTEX, SEGMENT_FRAGMENT);
    this.box = this.buffer(new Float32Array([
      -1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1, -1, -1, 1, 1, -1, 1, -1, 1, 1, 1, 1, 1]));
    this.boxFaces = this.buffer(new Uint16Array([
      0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
      2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5]), gl.ELEMENT_ARRAY_BUFFER);
    this.ribbon = this.buffer(new Float32Array([0, -1, 1, -1, 0, 1, 1, 1, 0, 0, 1, 0]));
    this.meshes = scene.meshes.map((mesh) => this.uploadMesh(mesh));
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  }

  link(vertex, fragment) {
    const gl = this.gl, program = gl.createProgram();
    for (const [type, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) {
        throw new Error('A shader does not compile: ' + gl.getShaderInfoLog(shader));
      }
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
      throw new Error('A shader does not link: ' + gl.getProgramInfoLog(program));
    }
    const uniforms = {};
    for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); ++i) {
      const {name} = gl.getActiveUniform(program, i);
      uniforms[name] = gl.getUniformLocation(program, name);
    }
    return {program, uniforms};
  }

  buffer(values, target = this.gl.ARRAY_BUFFER) {
    const buffer = this.gl.createBuffer();
    this.gl.bindBuffer(target, buffer);
    this.gl.bufferData(target, values, this.gl.STATIC_DRAW);
    return buffer;
  }

  uploadMesh(mesh) {
    const gl = this.gl;
    const uploaded = {color: mesh.color.map((c) => c / 255), opacity: 1, matrix: mesh.matrix,
      levels: []};
    if (mesh.positions) {
      const triangles = decode(mesh.triangles, Uint32Array);
      const edges = new Uint32Array(2 * triangles.length);
      for (let i = 0; i < triangles.length; ++i) {
        edges[2 * i] = triangles[i];
        edges[2 * i + 1] = triangles[i % 3 === 2 ? i - 2 : i + 1];
      }
      const positions = this.buffer(decode(mesh.positions, Float32Array));
      const withIndices = (indices) => {
        const array = gl.createVertexArray();
        gl.bindVertexArray(array);
        gl.bindBuffer(gl.ARRAY_BUFFER, positions);
        gl.enableVertexAttribArray(0);
        gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
        this.buffer(indices, gl.ELEMENT_ARRAY_BUFFER);
        gl.bindVertexArray(null);
        return {array, count: indices.length};
      };
      uploaded.faces = withIndices(triangles);
      uploaded.edges = withIndices(edges);
      if (mesh.marked) uploaded.marked = withIndices(decode(mesh.marked, Uint32Array));
    }
    for (const level of mesh.levels) {
      const values = decode(level, Float32Array);
      const array = gl.createVertexArray();
      gl.bindVertexArray(array);
      gl.bindBuffer(gl.ARRAY_BUFFER, this.box);
      gl.enableVertexAttribArray(0);
      gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
      this.buffer(values);
      for (let i = 0; i < 8; ++i) {
        gl.enableVertexAttribArray(i + 1);
        gl.vertexAttribPointer(i + 1, 4, gl.FLOAT, false, 128, 16 * i);
        gl.vertexAttribDivisor(i + 1, 1);
      }
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.boxFaces);
      gl.bindVertexArray(null);
      uploaded.levels.push({array, count: values.length / 32});
    }
    return uploaded;
  }

  /**
   * camera: {view: Mat, projection: Mat, pixel: size of a pixel at distance 1};
   * shown: {level, opacity, volumes, mesh, edges, segment}. Between pictures a page may set the
   * matrix, the colour, the opacity and `hidden` of a mesh, the scene's segment and its colour.
   */
  draw(camera, shown) {
    const gl = this.gl, {width, height} = gl.canvas;
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const views = this.meshes.map((mesh) => multiply(camera.view, mesh.matrix));
    if (shown.mesh) {
      // What one looks through comes last, the faintest at the end; only the foremost is blended.
      const byOpacity = this.meshes.map((m, i) => [m, views[i]]).sort(
        ([m], [n]) => n.opacity - m.opacity);
      for (const [mesh, view] of byOpacity) this.drawMesh(mesh, view, camera, shown);
    }
    if (shown.volumes) {
      // Only the foremost volume of a pixel is blended: no order is needed.
      const {program, uniforms} = this.volumeProgram;
      gl.useProgram(program);
      gl.uniform1f(uniforms.pixel, camera.pixel);
      gl.uniform1f(uniforms.opacity, shown.opacity);
      gl.enable(gl.CULL_FACE);
      gl.cullFace(gl.FRONT);
      for (const colors of [false, true]) {
        gl.colorMask(colors, colors, colors, colors);
        if (colors) gl.enable(gl.BLEND);
        this.meshes.forEach((m, i) => this.drawVolumes(m, views[i], camera, shown, uniforms));
      }
      gl.disable(gl.BLEND);
      gl.disable(gl.CULL_FACE);
    }
    if (this.scene.segment && shown.segment) this.drawSegment(camera, shown);
    gl.bindVertexArray(null);
  }

  drawMesh(mesh, view, camera, shown) {
    if (!mesh.faces || mesh.hidden) return;
    const gl = this.gl, {program, uniforms} = this.meshProgram;
    gl.useProgram(program);
    gl.uniformMatrix4fv(uniforms.toView, false, view);
    gl.uniformMatrix4fv(uniforms.toClip, false, multiply(camera.projection, view));
    gl.uniform4f(uniforms.color, ...mesh.color, mesh.opacity);
    gl.uniform1i(uniforms.flatColor, 0);
    if (mesh.opacity < 1) gl.enable(gl.BLEND);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1, 1);
    gl.bindVertexArray(mesh.faces.array);
    gl.drawElements(gl.TRIANGLES, mesh.faces.count, gl.UNSIGNED_INT, 0);
    if (mesh.marked) {
      gl.uniform4f(uniforms.color, ...RED, mesh.opacity);
      gl.bindVertexArray(mesh.marked.array);
      gl.drawElements(gl.TRIANGLES, mesh.marked.count, gl.UNSIGNED_INT, 0);
    }
    gl.disable(gl.POLYGON_OFFSET_FILL);
    gl.disable(gl.BLEND);
    if (!shown.edges || mesh.opacity < 1) return;
    gl.enable(gl.BLEND);
    gl.uniform4f(uniforms.color, 0.08, 0.1, 0.14, 0.55);
    gl.uniform1i(uniforms.flatColor, 1);
    gl.bindVertexArray(mesh.edges.array);
    gl.drawElements(gl.LINES, mesh.edges.count, gl.UNSIGNED_INT, 0);
    gl.disable(gl.BLEND);
  }

  drawVolumes(mesh, view, camera, shown, uniforms) {
    const gl = this.gl, level = mesh.levels[Math.min(shown.level, mesh.levels.length - 1)];
    if (!level) return;
    const toView = [0, 1, 2, 4, 5, 6, 8, 9, 10].map((i) => view[i]);
    // The eye in the mesh's frame: -R^T t.
    const eye = [0, 1, 2].map((i) => -(toView[3 * i] * view[12] + toView[3 * i + 1] * view[13] +
      toView[3 * i + 2] * view[14]));
    gl.uniformMatrix4fv(uniforms.toClip, false, multiply(camera.projection, view));
    gl.uniformMatrix3fv(uniforms.toView, false, toView);
    gl.uniform3f(uniforms.eye, ...eye);
    gl.bindVertexArray(level.array);
    gl.drawElementsInstanced(gl.TRIANGLES, 36, gl.UNSIGNED_SHORT, 0, level.count);
  }

  drawSegment(camera, shown) {
    const gl = this.gl, {program, uniforms} = this.segmentProgram, [from, to] = this.scene.segment;
    gl.useProgram(program);
    gl.uniformMatrix4fv(uniforms.toClip, false, multiply(camera.projection, camera.view));
    gl.uniform3f(uniforms.from, ...from);
    gl.uniform3f(uniforms.to, ...to);
    gl.uniform2f(uniforms.size, gl.canvas.width, gl.canvas.height);
    gl.uniform1f(uniforms.width, 2 * shown.ratio);
    gl.uniform4f(uniforms.color, ...(this.scene.segmentColor || RED), 1);
    gl.bindVertexArray(null);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.ribbon);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 0, 0);
    gl.disable(gl.DEPTH_TEST);
    gl.uniform1i(uniforms.dot, 0);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
    gl.uniform1i(uniforms.dot, 1);
    gl.drawArrays(gl.POINTS, 4, 2);
    gl.enable(gl.DEPTH_TEST);
    gl.disableVertexAttribArray(0);
  }
}

/** Product of 4 x 4 matrices, column by column. */
function multiply(a, b) {
  const result = new Array(16).fill(0);
  for (let column = 0; column < 4; ++column) {
    for (let row = 0; row < 4; ++row) {
      for (let k = 0; k < 4; ++k) result[4 * column + row] += a[4 * k + row] * b[4 * column + k];
    }
  }
  return result;
}
