// The scene in three dimensions: the structure as its interest points, boxes, tracks, and the fleet at one moment.
import * as THREE from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';
import {Line2} from 'three/addons/lines/Line2.js';
import {LineGeometry} from 'three/addons/lines/LineGeometry.js';
import {LineMaterial} from 'three/addons/lines/LineMaterial.js';

import {colour, data, element, indexAt, moment, onTheme, replaceDrawing, track, trackColour} from './page.js';

const kPerPoint = 9;  // numbers of a point in the data
const kDetected = 0.2;
const count = data.points.length / kPerPoint;

const point = (i) => {
  const at = i * kPerPoint;
  const [x, y, z, nx, ny, nz, score, estimate, cause] = data.points.slice(at, at + kPerPoint);
  return {
    p: new THREE.Vector3(x, y, z).multiplyScalar(0.01),
    n: new THREE.Vector3(nx, ny, nz).multiplyScalar(0.01),
    score: score / 1000,
    estimate: estimate / 1000,
    cause,
    uav: data.best[2 * i],
    taken: data.best[2 * i + 1] / 1000,
  };
};
const points = Array.from({length: count}, (_, i) => point(i));
const tracks = data.uavs.map(track);

const scoreColour = (score) =>
    score < kDetected ? 'q0' : `q${1 + Math.min(Math.floor(((score - kDetected) / (1 - kDetected)) * 4), 3)}`;

/** Half of the usual distance between neighbours: discs of that size make a surface. */
function discRadius() {
  const distances = [];
  for (let k = 0; k < Math.min(count, 60); ++k) {
    const from = points[Math.floor((k * count) / 60) % count];
    let least = Infinity;
    for (const other of points)
      if (other !== from) least = Math.min(least, from.p.distanceToSquared(other.p));
    if (Number.isFinite(least)) distances.push(Math.sqrt(least));
  }
  distances.sort((a, b) => a - b);
  return Math.min(Math.max(0.8 * (distances[distances.length >> 1] ?? 0.5), 0.12), 1.2);
}

function makeStructure() {
  const mesh = new THREE.InstancedMesh(
      new THREE.CircleGeometry(discRadius(), 10), new THREE.MeshLambertMaterial({side: THREE.DoubleSide}), count);
  const along = new THREE.Vector3(0, 0, 1);
  const turn = new THREE.Quaternion();
  const unit = new THREE.Vector3(1, 1, 1);
  points.forEach(({p, n}, i) => {
    turn.setFromUnitVectors(along, n.lengthSq() > 0.5 ? n.clone().normalize() : along);
    mesh.setMatrixAt(i, new THREE.Matrix4().compose(p, turn, unit));
  });
  return mesh;
}

function makeBoxes() {
  const ends = [];
  for (const box of data.boxes) {
    for (let i = 0; i < 8; ++i) {
      for (const bit of [1, 2, 4])
        if ((i & bit) === 0) ends.push(...box[i], ...box[i | bit]);
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(ends.map((cm) => cm / 100), 3));
  return new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({transparent: true, opacity: 0.7}));
}

/** Its first segments are drawn, up to where the UAV is. */
function makeTrack(t) {
  if (t.t.length < 2) return null;
  const flat = [];
  for (let i = 0; i < t.t.length; ++i) flat.push(t.x[i], t.y[i], t.z[i]);
  const geometry = new LineGeometry();
  geometry.setPositions(flat);
  return new Line2(geometry, new LineMaterial({linewidth: 1.7, transparent: true, opacity: 0.6}));
}

function bounds() {
  const box = new THREE.Box3();
  for (const {p} of points) box.expandByPoint(p);
  for (const corners of data.boxes)
    for (const c of corners) box.expandByPoint(new THREE.Vector3(...c).multiplyScalar(0.01));
  if (box.isEmpty())
    for (const t of tracks) t.t.forEach((_, i) => box.expandByPoint(new THREE.Vector3(t.x[i], t.y[i], t.z[i])));
  if (box.isEmpty()) box.expandByPoint(new THREE.Vector3());
  return box;
}

class Scene {
  constructor(stage, tip) {
    this.stage = stage;
    this.tip = tip;
    this.renderer = new THREE.WebGLRenderer({antialias: true});
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    stage.append(this.renderer.domElement);
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(40, 1, 0.1, 5000);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.addEventListener('change', () => this.draw());
    this.by = 'score';
    this.fill();
    this.lookFrom();
    moment.listen(() => this.show());
    onTheme(() => this.paint());
    new ResizeObserver(() => this.fit()).observe(stage);
    this.fit();
    this.renderer.domElement.addEventListener('pointermove', (event) => this.point(event));
  }

  fill() {
    const sun = new THREE.DirectionalLight(0xffffff, 1.6);
    sun.position.set(-0.5, -1, 1.6);
    this.scene.add(new THREE.AmbientLight(0xffffff, 2.0), sun);
    this.structure = makeStructure();
    this.boxes = makeBoxes();
    this.tracks = new THREE.Group();
    this.lines = tracks.map(makeTrack);
    for (const line of this.lines)
      if (line) this.tracks.add(line);
    this.fleet = new THREE.Group();
    this.bodies = data.uavs.map((uav) => {
      const body = new THREE.Mesh(
          uav.explorer ? new THREE.OctahedronGeometry(1.1) : new THREE.SphereGeometry(0.8, 16, 12),
          new THREE.MeshBasicMaterial());
      this.fleet.add(body);
      return body;
    });
    this.tags = data.uavs.map((uav) => {
      const tag = element('span', {class: 'tag'}, uav.name);
      if (data.uavs.length <= 20) this.stage.append(tag);
      return tag;
    });
    this.marks = new THREE.Group();
    const mark = (cm, geometry, name) => {
      const mesh = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial());
      mesh.position.fromArray(cm).multiplyScalar(0.01);
      mesh.userData.colour = name;
      this.marks.add(mesh);
      return mesh;
    };
    if (data.station) mark(data.station, new THREE.ConeGeometry(1.2, 3, 20).rotateX(Math.PI / 2), 'ink');
    for (const place of data.collisions) mark(place, new THREE.IcosahedronGeometry(1.3), 'bad');
    this.scene.add(this.structure, this.boxes, this.tracks, this.fleet, this.marks);
  }

  lookFrom() {
    const box = bounds();
    const middle = box.getCenter(new THREE.Vector3());
    const size = Math.max(box.getSize(new THREE.Vector3()).length(), 10);
    this.extent = size;
    this.controls.target.copy(middle).z -= 0.06 * size;
    const narrow = this.stage.clientWidth < 600 ? 1.45 : 1.0;
    this.camera.position.copy(middle).add(new THREE.Vector3(0.4, -0.95, 0.36).multiplyScalar(size * 0.86 * narrow));
    const cells = Math.min(Math.ceil((size * 1.6) / 10), 60);
    this.ground = new THREE.GridHelper(cells * 10, cells).rotateX(Math.PI / 2);
    this.ground.position.set(Math.round(middle.x / 10) * 10, Math.round(middle.y / 10) * 10, 0);
    this.scene.add(this.ground);
    this.controls.update();
  }

  /** All colours anew. */
  paint() {
    this.scene.background = new THREE.Color(colour('panel'));
    this.boxes.material.color.set(colour('soft'));
    this.ground.material.color.set(colour('line'));
    this.ground.material.vertexColors = false;
    this.ground.material.needsUpdate = true;
    this.lines.forEach((line, uav) => line?.material.color.set(colour(trackColour(uav))));
    this.bodies.forEach((body, uav) => body.material.color.set(colour(trackColour(uav))));
    this.tags.forEach((tag, uav) => {
      tag.style.color = colour(trackColour(uav));
    });
    for (const mesh of this.marks.children) mesh.material.color.set(colour(mesh.userData.colour));
    this.show();
  }

  colourOf({score, cause, uav, taken, estimate}, seconds, over) {
    if (this.by === 'estimate') return scoreColour(estimate);
    if (this.by === 'cause') return cause < 0 ? 'q0' : `k${cause}`;
    if (uav < 0 || (!over && taken > seconds)) return 'q0';
    return this.by === 'uav' ? trackColour(uav) : scoreColour(score);
  }

  /** As it was at the moment. */
  show() {
    const {seconds} = moment;
    const over = seconds >= data.end;
    const known = new Map();
    const named = (name) => {
      if (!known.has(name)) known.set(name, new THREE.Color(colour(name)));
      return known.get(name);
    };
    points.forEach((p, i) => this.structure.setColorAt(i, named(this.colourOf(p, seconds, over))));
    if (this.structure.instanceColor) this.structure.instanceColor.needsUpdate = true;
    tracks.forEach((t, uav) => {
      const at = indexAt(t.t, seconds);
      const body = this.bodies[uav];
      body.visible = at >= 0;
      if (at < 0) return;
      const next = Math.min(at + 1, t.t.length - 1);
      const share = next > at ? Math.min((seconds - t.t[at]) / (t.t[next] - t.t[at]), 1) : 0;
      body.position.set(...['x', 'y', 'z'].map((axis) => t[axis][at] + share * (t[axis][next] - t[axis][at])));
      if (this.lines[uav]) this.lines[uav].geometry.instanceCount = Math.max(at, 1);
    });
    this.draw();
  }

  fit() {
    const {clientWidth: width, clientHeight: height} = this.stage;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  draw() {
    this.renderer.render(this.scene, this.camera);
    const {clientWidth: width, clientHeight: height} = this.stage;
    this.bodies.forEach((body, uav) => {
      const at = body.position.clone().project(this.camera);
      const tag = this.tags[uav];
      const visible = this.fleet.visible && body.visible && at.z < 1;
      tag.style.display = visible ? '' : 'none';
      if (visible)
        tag.style.transform = `translate(${((at.x + 1) / 2) * width + 9}px, ${((1 - at.y) / 2) * height - 18}px)`;
    });
  }

  /** Tells of the point below the pointer. */
  point(event) {
    if (event.buttons !== 0 || count === 0) return;
    const {left, top, width, height} = this.renderer.domElement.getBoundingClientRect();
    const ray = new THREE.Raycaster();
    ray.setFromCamera(
        new THREE.Vector2(((event.clientX - left) / width) * 2 - 1, 1 - ((event.clientY - top) / height) * 2),
        this.camera);
    const hit = this.structure.visible ? ray.intersectObject(this.structure)[0] : undefined;
    this.tip.hidden = hit === undefined;
    if (hit === undefined) return;
    const p = points[hit.instanceId];
    const parts = [`point ${hit.instanceId}`, `score ${p.score.toFixed(3)}`];
    if (data.causes_known)
      parts.push(
          `could be had ${p.estimate.toFixed(3)}`, p.cause < 0 ? 'nothing lost' : `lost: ${data.causes[p.cause]}`);
    if (p.uav >= 0) parts.push(`by ${data.uavs[p.uav].name} at ${p.taken.toFixed(1)} s`);
    this.tip.textContent = parts.join(' · ');
  }
}

function legendOf(by) {
  const entry = (name, text) => {
    const swatch = element('span', {class: 'swatch'});
    swatch.style.background = `var(--${name})`;
    return element('li', {}, swatch, text);
  };
  if (by === 'uav')
    return [
      ...data.uavs.slice(0, 12).map((uav, i) => entry(trackColour(i), `by ${uav.name}`)), entry('q0', 'by nobody')
    ];
  if (by === 'cause') {
    const there = new Set(points.map((p) => p.cause));
    return [
      ...data.causes.flatMap((cause, i) => (there.has(i) ? [entry(`k${i}`, cause)] : [])), entry('q0', 'nothing lost')
    ];
  }
  const steps = [[0.2, 0.4], [0.4, 0.6], [0.6, 0.8], [0.8, 1]].map(
      ([from, to], i) => entry(`q${i + 1}`, `${from.toFixed(1)} to ${to.toFixed(1)}`));
  return [entry('q0', by === 'estimate' ? 'not attainable' : 'not detected'), ...steps];
}

function layer(name, objects, scene) {
  const box = element('input', {type: 'checkbox'});
  box.checked = true;
  box.addEventListener('change', () => {
    for (const object of objects) object.visible = box.checked;
    scene.draw();
  });
  return element('label', {}, box, name);
}

/** Slider and play button of the moment; a run plays in half a minute. */
function timeTools() {
  const slider = element(
      'input', {type: 'range', min: '0', max: String(data.end), step: 'any', 'aria-label': 'time', id: 'moment'});
  slider.value = String(data.end);
  const shown = element('output', {}, '');
  const play = element('button', {type: 'button'}, 'Play');
  let last = null;
  const stop = () => {
    last = null;
    play.textContent = 'Play';
  };
  const turn = (now) => {
    if (last === null) return;
    moment.set(moment.seconds + ((now - last) / 1000) * Math.max(data.end / 30, 1));
    last = now;
    if (moment.seconds >= data.end)
      stop();
    else
      requestAnimationFrame(turn);
  };
  play.addEventListener('click', () => {
    if (last !== null) return stop();
    if (moment.seconds >= data.end) moment.set(0);
    last = performance.now();
    play.textContent = 'Pause';
    requestAnimationFrame(turn);
  });
  slider.addEventListener('input', () => moment.set(Number(slider.value)));
  const tell = (seconds) => {
    slider.value = String(seconds);
    shown.textContent = `${seconds.toFixed(1)} s`;
  };
  moment.listen(tell);
  tell(moment.seconds);
  return element('span', {class: 'time'}, play, slider, shown);
}

export function sceneView(figure) {
  if (document.createElement('canvas').getContext('webgl2') === null) return;  // the drawing stays
  const stage = element('div', {class: 'stage'});
  const tip = element('div', {class: 'tip'});
  tip.hidden = true;
  const live = element('div', {class: 'live'});
  figure.classList.add('scene');
  figure.parentElement.classList.add('with-scene');
  figure.querySelector('figcaption').textContent = 'In three dimensions';
  replaceDrawing(figure, live);
  live.append(stage);
  const scene = new Scene(stage, tip);
  stage.append(tip);
  const legend = element('ul', {class: 'legend'}, ...legendOf('score'));
  const choice = element('select', {id: 'colour-by', 'aria-label': 'colour of the points'});
  const colours = [
    ['score', 'score'],
    ...(data.causes_known ? [['cause', 'cause of the loss'], ['estimate', 'what could be had']] : []), ['uav', 'UAV']
  ];
  for (const [value, text] of colours) choice.append(element('option', {value}, text));
  choice.addEventListener('change', () => {
    scene.by = choice.value;
    legend.replaceChildren(...legendOf(scene.by));
    scene.show();
  });
  const tools = element(
      'div', {class: 'tools'}, element('label', {}, 'Points by', choice), layer('points', [scene.structure], scene),
      layer('tracks', [scene.tracks], scene), layer('boxes', [scene.boxes], scene), layer('UAVs', [scene.fleet], scene),
      layer('station, collisions', [scene.marks], scene), timeTools());
  live.prepend(tools);
  live.append(legend);
  scene.fit();
}
