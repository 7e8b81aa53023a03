// Data that the server sends only to pages that request them: LiDAR points, and the map of one UAV. There is one draw
// call for all points, one for the occupied cubes of the map, and one for its free cubes.
import * as THREE from 'three';

import {colour, data, element, growth, moment, trackColour} from './page.js';
import {unpackedPoints, unpackedRuns} from './packed.js';

const kAskAgain = 2000;    // ms between two renewals of the request, which expires after three times as long
const kMostPoints = 60000; // of all UAVs; a new point then replaces the oldest
const kCell = 0.5;         // m; a UAV has at most one point in each cube of this size
const kNew = 1;            // s; new points are drawn larger for this long
const kHeights = ['c0', 'c2', 'c4', 'c1'];  // colours from the ground upwards

const maps = new Map();     // name of a UAV -> the newest message about its map
const scans = new Map();    // name of a UAV -> its newest points; in a replay all of them
let layers = null;
let fresh = false;          // data have arrived that no picture shows yet

/** @returns a function from height to colour; the scale ends at the height of the boxes. */
function heightColours() {
  const named = kHeights.map((name) => new THREE.Color(colour(name)));
  const top = Math.max(...data.boxes.flat().map(([, , z]) => z / 100), 10);
  return (z, into) => {
    const at = Math.min(Math.max(z / top, 0), 0.9999) * (named.length - 1);
    return into.lerpColors(named[Math.floor(at)], named[Math.floor(at) + 1], at % 1);
  };
}

const vertexShader = `
attribute vec2 seen;  // first, last [s]
attribute vec3 tint;
uniform float now, size;
varying vec3 shade;
void main() {
  shade = tint;
  vec4 place = modelViewMatrix * vec4(position, 1.0);
  gl_Position = seen.x > now ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * place;
  gl_PointSize = clamp(size / -place.z, 2.0, 9.0) * (now - seen.y < ${kNew.toFixed(1)} ? 1.6 : 1.0);
}`;
const fragmentShader = `
varying vec3 shade;
void main() {
  vec2 off = gl_PointCoord - 0.5;
  if (dot(off, off) > 0.25) discard;
  gl_FragColor = vec4(shade, 1.0);
  #include <colorspace_fragment>
}`;

/** LiDAR points of all UAVs, in a ring buffer: when it is full, new points replace the oldest. */
class Points {
  constructor() {
    const attribute = (name, size) => {
      const made = new THREE.BufferAttribute(new Float32Array(size * kMostPoints), size);
      this.geometry.setAttribute(name, made);
      return made;
    };
    this.geometry = new THREE.BufferGeometry();
    [this.position, this.seen, this.tint] = [['position', 3], ['seen', 2], ['tint', 3]].map((one) => attribute(...one));
    this.material = new THREE.ShaderMaterial(
        {vertexShader, fragmentShader, uniforms: {now: {value: 0}, size: {value: 420}}});
    this.object = new THREE.Points(this.geometry, this.material);
    this.object.frustumCulled = false;
    this.uavs = new Uint16Array(kMostPoints);
    this.clear();
  }

  clear() {
    this.slots = new Map();  // cube -> index in the ring
    this.keys = new Array(kMostPoints);
    this.next = this.count = 0;
    this.geometry.setDrawRange(0, 0);
  }

  add(uav, time, points, shade) {
    const across = 1 << 14;
    for (let i = 0; i < points.length; i += 3) {
      let key = uav;
      for (let axis = 0; axis < 3; ++axis) key = key * across + (Math.floor(points[i + axis] / kCell) + across / 2) % across;
      let slot = this.slots.get(key);
      if (slot !== undefined) {
        this.seen.array[2 * slot] = Math.min(this.seen.array[2 * slot], time);
        this.seen.array[2 * slot + 1] = Math.max(this.seen.array[2 * slot + 1], time);
        continue;
      }
      slot = this.next;
      this.next = (this.next + 1) % kMostPoints;
      if (this.count === kMostPoints) this.slots.delete(this.keys[slot]);
      this.count = Math.min(this.count + 1, kMostPoints);
      this.slots.set(key, slot);
      this.keys[slot] = key;
      this.uavs[slot] = uav;
      this.position.array.set(points.subarray(i, i + 3), 3 * slot);
      this.seen.array.set([time, time], 2 * slot);
      shade(uav, points[i + 2]).toArray(this.tint.array, 3 * slot);
    }
    this.update();
  }

  paint(shade) {
    for (let slot = 0; slot < this.count; ++slot)
      shade(this.uavs[slot], this.position.array[3 * slot + 2]).toArray(this.tint.array, 3 * slot);
    this.update();
  }

  update() {
    for (const attribute of [this.position, this.seen, this.tint]) attribute.needsUpdate = true;
    this.geometry.setDrawRange(0, this.count);
  }
}

/** Cubes of a map, as rows along x: one instance per row. The rows that are shown depend on the moment. */
class Rows {
  constructor(geometry, material) {
    [this.geometry, this.material] = [geometry, material];
    this.object = new THREE.Group();
    this.steps = [];  // {t, until, runs, cubes}; until is Infinity for rows that stay
    this.times = [];  // at which rows appear or disappear, ascending [s]
  }

  /**
   * @param steps  {t, until?, runs}: rows that exist from t to until [s].
   * @param cell  edge of a cube [m]. @param squeeze  by axis: share of the edge that is drawn.
   */
  set(steps, cell, squeeze) {
    [this.cell, this.squeeze] = [cell, squeeze];
    this.steps = steps.map(({t, until = Infinity, runs}) => ({t, until, runs: unpackedRuns(runs)}));
    for (const step of this.steps) {
      step.cubes = 0;
      for (let i = 3; i < step.runs.length; i += 4) step.cubes += step.runs[i];
    }
    this.times = [...new Set(this.steps.flatMap(({t, until}) => [t, until]))].sort((one, other) => one - other);
    const rows = (now) => this.steps.reduce((sum, {t, until, runs}) => (t <= now && now < until ? sum + runs.length / 4 : sum), 0);
    const count = Math.max(0, ...this.times.map(rows));  // most rows at any one time
    if (!this.mesh || count > this.mesh.instanceMatrix.count) {
      this.mesh?.dispose();
      this.mesh = new THREE.InstancedMesh(this.geometry, this.material, Math.max(2 * count, 256));
      this.mesh.frustumCulled = false;
      this.object.clear().add(this.mesh);
    }
    this.shown = null;
  }

  /** @param shade  function from height to colour; none: the material's colour. */
  paint(shade) {
    this.shade = shade;
    this.shown = null;
  }

  /** Shows the rows of a moment. Instances are set anew only if the rows differ from those of the last call. */
  show(seconds) {
    if (!this.mesh) return;
    const now = seconds + 1e-6;
    const shown = this.times.findLastIndex((time) => time <= now);
    if (shown === this.shown) return;
    this.shown = shown;
    this.cubes = 0;
    let at = 0;
    for (const {t, until, runs, cubes} of this.steps) {
      if (t > now || until <= now) continue;
      this.cubes += cubes;
      for (let i = 0; i < runs.length; i += 4) this.place(at++, runs[i], runs[i + 1], runs[i + 2], runs[i + 3]);
    }
    this.mesh.count = at;
    this.mesh.instanceMatrix.needsUpdate = true;
    if (this.shade && this.mesh.instanceColor) this.mesh.instanceColor.needsUpdate = true;
  }

  place(at, x, y, z, length) {
    const {cell, squeeze: [sx, sy, sz]} = this;
    const high = (z + 0.5) * cell;
    this.mesh.instanceMatrix.array.set([
      (length - 1 + sx) * cell, 0, 0, 0, 0, sy * cell, 0, 0, 0, 0, sz * cell, 0,
      (x + length / 2) * cell, (y + 0.5) * cell, high, 1], 16 * at);
    if (this.shade) this.mesh.setColorAt(at, this.shade(high));
  }
}

class Layers {
  constructor(scene) {
    this.scene = scene;
    this.points = new Points();
    this.occupied = new Rows(new THREE.BoxGeometry(), new THREE.MeshLambertMaterial());
    this.free = new Rows(
        new THREE.PlaneGeometry(),
        new THREE.MeshBasicMaterial({transparent: true, opacity: 0.3, depthWrite: false, side: THREE.DoubleSide}));
    this.object = new THREE.Group();
    this.object.add(this.points.object, this.occupied.object, this.free.object);
    scene.scene.add(this.object);
    this.chosen = {lidar: '', map: '', free: true, by: 'height'};
    this.note = element('span', {id: 'clouds-note', class: 'soft', role: 'status'});
    this.asked = '';
    setInterval(() => this.ask(), kAskAgain);
    growth.listen(() => this.takeFresh());
  }

  /** Draws new data if the page shows a moment in the past; the newest moment is drawn anew in any case. */
  takeFresh() {
    if (fresh && !moment.newest) {
      this.show(moment.seconds);
      this.scene.draw();
    }
    fresh = false;
  }

  /** @returns the names of the UAVs whose points are requested. */
  lidar() {
    const {lidar} = this.chosen;
    if (lidar !== 'followed') return lidar === 'all' ? data.clouds.lidar : [];
    const followed = data.uavs[this.scene.followed]?.name;
    return data.clouds.lidar.filter((name) => name === followed);
  }

  /** Sends the current request. A request with content is sent again and again, because it expires. */
  ask() {
    const lidar = this.lidar();
    const order = {do: 'look', ...(lidar.length > 0 ? {lidar} : {}), ...(this.chosen.map ? {map: this.chosen.map} : {})};
    const text = JSON.stringify(order);
    if (Object.keys(order).length > 1 || text !== this.asked) data.ask(order);
    this.asked = text;
  }

  shade() {
    if (this.chosen.by === 'height') {
      const high = heightColours();
      const into = new THREE.Color();
      return (_, z) => high(z, into);
    }
    const colours = data.uavs.map((_, uav) => new THREE.Color(colour(trackColour(uav))));
    return (uav) => colours[uav];
  }

  /**
   * Removes all points. In a replay, the points of the requested UAVs have all been received already: adds them again.
   */
  clearPoints() {
    this.points.clear();
    if (data.mode === 'replay')
      for (const name of this.lidar()) this.addPoints(name, scans.get(name) ?? []);
  }

  addPoints(name, steps) {
    const uav = data.uavs.findIndex((one) => one.name === name);
    if (uav < 0 || !this.lidar().includes(name)) return;
    const shade = this.shade();
    for (const {t, points} of steps) this.points.add(uav, t, unpackedPoints(points), shade);
  }

  showMap() {
    const map = maps.get(this.chosen.map);
    this.occupied.object.visible = this.free.object.visible = map?.steps !== undefined;
    if (!map?.steps) return;
    this.occupied.set(map.steps, map.cell, [0.9, 0.9, 0.9]);
    this.free.set(map.freeSteps ?? (map.free ? [{t: map.t, runs: map.free}] : []), map.freeCell ?? map.cell, [1, 1, 0.02]);
    this.paintMap();
  }

  paintMap() {
    const shade = this.shade();
    const uav = data.uavs.findIndex((one) => one.name === this.chosen.map);
    if (uav < 0) return;
    this.occupied.paint((z) => shade(uav, z));
    this.free.material.color.set(colour('direct'));
  }

  paint() {
    this.points.paint(this.shade());
    this.paintMap();
    this.show(moment.seconds);
  }

  choose(what) {
    const before = this.lidar().join();
    Object.assign(this.chosen, what);
    if (this.lidar().join() !== before) this.clearPoints();
    this.ask();
    this.showMap();
    this.paint();
    this.scene.draw();
  }

  /** Shows the data of a moment. Call it before each picture. */
  show(seconds) {
    if (this.chosen.lidar === 'followed' && this.scene.followed !== this.last) {
      this.last = this.scene.followed;
      this.clearPoints();
      this.ask();
    }
    this.points.object.visible = this.lidar().length > 0;
    const now = moment.newest ? data.end : seconds;
    this.points.material.uniforms.now.value = now;
    this.occupied.show(now);
    this.free.show(now);
    this.free.object.visible = this.occupied.object.visible && this.chosen.free;
    this.tell(seconds);
  }

  tell(seconds) {
    const parts = [];
    const lidar = this.lidar();
    if (this.chosen.lidar === 'followed' && lidar.length === 0) parts.push('LiDAR points: follow a UAV that has a LiDAR');
    if (lidar.length > 0) {
      const last = Math.max(...lidar.map((name) => scans.get(name)?.at(-1)?.t ?? -Infinity));
      parts.push(last === -Infinity ? `LiDAR points ${data.mode === 'live' ? 'come with the next scan' : 'are being loaded'}` :
                                      `${this.points.count} LiDAR points${data.mode === 'live' ? `, the newest of ${last.toFixed(1)} s` : ''}`);
    }
    if (this.chosen.map) parts.push(this.tellMap(seconds));
    const text = parts.join(' · ');
    if (this.note.textContent !== text) this.note.textContent = text;
  }

  tellMap(seconds) {
    const name = this.chosen.map;
    const map = maps.get(name);
    if (map === undefined) return data.mode === 'live' ? `the map of ${name} comes with the next step` : `the map of ${name} is being loaded`;
    if (map.none) return `${name} has no map to show: ${map.none}`;
    const times = map.times ?? [map.t];  // times of its snapshots
    const now = moment.newest ? Infinity : seconds + 1e-6;
    const newest = times.findLast((time) => time <= now);
    if (newest === undefined)
      return `of this moment there is no map of ${name}: ${times.length > 1 ? 'the first is' : 'this one is'} of ${times[0].toFixed(1)} s`;
    return `${name}: ${map.kind}, of ${newest.toFixed(1)} s, ${this.occupied.cubes} cubes of ${map.cell} m`;
  }
}

/** Stores received points and maps; the page's next picture shows them. */
export function takeClouds(list) {
  for (const cloud of list) {
    const at = cloud.n.indexOf(' ');
    const [kind, name] = [cloud.n.slice(0, at), cloud.n.slice(at + 1)];
    if (kind === 'lidar') {
      scans.set(name, cloud.steps);
      layers?.addPoints(name, cloud.steps);
    }
    if (kind === 'map') {
      maps.set(name, cloud);
      if (layers?.chosen.map === name) layers.showMap();
    }
    fresh = true;
  }
}

/** Adds the layers to a scene. @returns them, with their controls in `tools`. */
export function makeClouds(scene) {
  layers = new Layers(scene);
  const {lidar, maps: mapped, missing = ''} = data.clouds;
  const select = (id, label, options) => element(
      'select', {id, 'aria-label': label}, ...options.map(([value, text]) => element('option', {value}, text)));
  const of = select('lidar-of', 'LiDAR points', [
    ['', 'no LiDAR points'], ['all', 'LiDAR points'], ['followed', 'LiDAR points of the followed UAV']]);
  const map = select('map-of', 'map', [['', 'no map'], ...mapped.map((name) => [name, `map of ${name}`])]);
  const by = select('clouds-by', 'colour of LiDAR points and maps', [['height', 'by height'], ['uav', 'by UAV']]);
  const free = element('input', {type: 'checkbox', id: 'map-free'});
  free.checked = true;
  of.disabled = lidar.length === 0;
  map.disabled = mapped.length === 0;
  if (missing) for (const one of [of, map]) one.title = missing;
  of.addEventListener('change', () => layers.choose({lidar: of.value}));
  map.addEventListener('change', () => layers.choose({map: map.value}));
  by.addEventListener('change', () => layers.choose({by: by.value}));
  free.addEventListener('change', () => layers.choose({free: free.checked}));
  layers.tools = element(
      'div', {class: 'tools', id: 'clouds'}, of, map, element('label', {}, free, 'free space at its height'), by, layers.note,
      ...(missing ? [element('span', {class: 'soft'}, missing)] : []));
  return layers;
}
