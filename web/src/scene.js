// The scene in three dimensions: the structure (drawn as its interest points), boxes, tracks, and the fleet at one
// moment. scene_view.js puts it on the page, with its tools and legends.
import * as THREE from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';

import {makeGoals} from './activity.js';
import {Fleet, Marks} from './bodies.js';
import {kDetected} from './custody.js';
import {countFrame} from './figures.js';
import {takeKeys} from './keys.js';
import {Labels} from './labels.js';
import {makeFrusta, makeLinks} from './overlays.js';
import {colour, data, indexAt, moment, onTheme, trackColour} from './page.js';
import {points, scoreColour, tracks} from './points.js';
import {bounds, makeBoxes, makeStructure} from './structure.js';
import {trailsOfRuns} from './trails.js';

const kMostNames = 20;

export class Scene {
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
    this.named = new Map();  // cache of colours by name
    this.painted = null;     // time for which the points are coloured
    this.size = {width: 1, height: 1};
    this.fill();
    this.lookFrom();
    moment.listen(() => this.show());
    onTheme(() => this.paint());
    new ResizeObserver(() => this.fit()).observe(stage);
    this.fit();
    const [eye, target] = [this.camera.position.clone(), this.controls.target.clone()];
    takeKeys(this.renderer.domElement, this.camera, this.controls, () => {
      this.camera.position.copy(eye);
      this.controls.target.copy(target);
      this.controls.update();
    });
    this.renderer.domElement.addEventListener('pointermove', (event) => this.point(event));
  }

  fill() {
    const sun = new THREE.DirectionalLight(0xffffff, 1.6);
    sun.position.set(-0.5, -1, 1.6);
    this.scene.add(new THREE.AmbientLight(0xffffff, 2.0), sun);
    this.structure = makeStructure();
    this.boxes = makeBoxes();
    this.trails = trailsOfRuns(tracks);
    this.fleet = new Fleet();
    this.bodies = this.fleet.bodies;
    this.labels = data.uavs.length <= kMostNames ? new Labels(this.stage, this.bodies) : null;
    this.marks = new Marks();
    this.tracks = new THREE.Group().add(...this.trails.map(({object}) => object));
    this.scene.add(this.structure, this.boxes, this.tracks, this.fleet.object, this.marks.object);
    // Only if the data of the flight contain cameras and links.
    this.frusta = data.poseAt && data.uavs.every(({hfov}) => hfov > 0) ? makeFrusta() : null;
    this.links = data.linksAt ? makeLinks(this.bodies, () => this.followed ?? -1) : null;
    this.goals = data.poseAt ? makeGoals(this.bodies) : null;
    for (const overlay of [this.frusta, this.links, this.goals])
      if (overlay) this.scene.add(overlay.object);
  }

  lookFrom() {
    const box = bounds();
    const middle = box.getCenter(new THREE.Vector3());
    const size = Math.max(box.getSize(new THREE.Vector3()).length(), 10);
    this.extent = size;
    this.controls.target.copy(middle).z -= 0.06 * size;
    const {clientWidth: width, clientHeight: height} = this.stage;
    const narrow = Math.max(width < 600 ? 1.45 : 1.0, width > 0 ? Math.min((1.15 * height) / width, 2.2) : 1.0);
    this.camera.position.copy(middle).add(new THREE.Vector3(0.4, -0.95, 0.36).multiplyScalar(size * 0.86 * narrow));
    const cells = Math.min(Math.ceil((size * 1.6) / 10), 60);
    this.ground = new THREE.GridHelper(cells * 10, cells).rotateX(Math.PI / 2);
    this.ground.position.set(Math.round(middle.x / 10) * 10, Math.round(middle.y / 10) * 10, 0);
    this.scene.add(this.ground);
    this.controls.update();
  }

  /** Sets all colours anew. */
  paint() {
    this.scene.background = new THREE.Color(colour('panel'));
    this.boxes.material.color.set(colour('soft'));
    this.ground.material.color.set(colour('line'));
    this.ground.material.vertexColors = false;
    this.ground.material.needsUpdate = true;
    for (const part of [...this.trails, this.fleet, this.labels, this.marks, this.frusta, this.links, this.goals, this.clouds]) part?.paint();
    this.named.clear();
    this.painted = null;
    this.show();
  }

  colourOf({score, cause, uav, taken, estimate}, index, seconds, over) {
    if (this.by === 'estimate') return scoreColour(estimate);
    if (this.by === 'cause') return cause < 0 ? 'q0' : `k${cause}`;
    if (data.custody) return this.colourOfCustody(data.custody(index, seconds));
    if (uav < 0 || (!over && taken > seconds)) return 'q0';
    return this.by === 'uav' ? trackColour(uav) : scoreColour(score);
  }

  colourOfCustody({delivered, taken}) {
    const shown = delivered !== null && delivered.q >= kDetected ? delivered : taken;
    if (shown === null || shown.q < kDetected) return 'q0';
    if (this.by === 'uav') return trackColour(shown.of.uav);
    return shown === delivered ? scoreColour(shown.q) : 'carried';
  }

  /**
   * Places a body: at the flight's pose if there is one, else interpolated on the track.
   * @returns index on the track.
   */
  place(body, uav, seconds) {
    if (data.poseAt) {
      const pose = data.poseAt(uav, seconds, moment.newest);
      body.visible = pose !== null;
      if (pose !== null) body.position.set(pose.x, pose.y, pose.z);
      return pose?.at ?? -1;
    }
    const t = tracks[uav];
    const at = indexAt(t.t, seconds);
    body.visible = at >= 0;
    if (at < 0) return at;
    const next = Math.min(at + 1, t.t.length - 1);
    const share = next > at ? Math.min((seconds - t.t[at]) / (t.t[next] - t.t[at]), 1) : 0;
    body.position.set(...['x', 'y', 'z'].map((axis) => t[axis][at] + share * (t[axis][next] - t[axis][at])));
    return at;
  }

  paintPoint(index, seconds, over) {
    const name = this.colourOf(points[index], index, seconds, over);
    if (!this.named.has(name)) this.named.set(name, new THREE.Color(colour(name)));
    this.structure.setColorAt(index, this.named.get(name));
  }

  /** Colours the points. On a live page, only points that have changed get a new colour. */
  paintPoints(seconds, over) {
    const changed = data.changedPoints && this.painted === Infinity && over ? data.changedPoints() : null;
    const time = over ? Infinity : seconds;
    if (changed === null && this.painted === time) return;
    if (changed === null) {
      data.changedPoints?.();
      for (let index = 0; index < points.length; ++index) this.paintPoint(index, seconds, over);
    } else
      for (const index of changed) this.paintPoint(index, seconds, over);
    this.painted = time;
    if (this.structure.instanceColor && changed?.size !== 0) this.structure.instanceColor.needsUpdate = true;
  }

  /** Shows the moment of the page. */
  show() {
    const {seconds} = moment;
    const over = seconds >= data.end;
    this.paintPoints(seconds, over);
    tracks.forEach((_, uav) => this.place(this.bodies[uav], uav, seconds));
    this.fleet.update();
    for (const trails of this.trails) trails.showUntil(seconds, (uav) => this.bodies[uav].visible);
    this.marks.show(seconds);
    this.frusta?.show(seconds);
    this.links?.show(seconds);
    this.goals?.show(seconds);
    this.clouds?.show(seconds);
    this.ride(seconds);
    this.draw();
    this.shown = seconds;
  }

  /** Makes the view follow a UAV; -1: none. @param through  the view is that of its camera. */
  follow(uav, through = false) {
    if (this.through && !through) this.camera.fov = 40;
    this.followed = uav;
    this.through = through && uav >= 0 && data.poseAt !== undefined;
    this.controls.enabled = !this.through;
    if (this.through) this.camera.fov = data.uavs[uav].vfov;
    this.last = null;
    this.show();
    this.controls.update();
    this.fit();
  }

  ride(seconds) {
    if (!(this.followed >= 0)) return;
    const {position} = this.bodies[this.followed];
    if (this.through) {
      const pose = data.poseAt(this.followed, seconds, moment.newest);
      if (pose === null) return;
      const {yaw, pitch} = pose;
      this.camera.position.copy(position);
      this.camera.lookAt(position.clone().add(
          new THREE.Vector3(Math.cos(pitch) * Math.cos(yaw), Math.cos(pitch) * Math.sin(yaw), -Math.sin(pitch))));
      return;
    }
    // The view keeps its distance and its angle.
    this.camera.position.add(position).sub(this.last ?? this.controls.target);
    this.controls.target.copy(position);
    this.last = position.clone();
    this.controls.update();
  }

  fit() {
    const {clientWidth: width, clientHeight: height} = this.stage;
    if (width === 0 || height === 0) return;
    this.size = {width, height};  // stored, because reading it from the page for each picture would be slow
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  draw() {
    const early = !this.isFinished();
    this.renderer.render(this.scene, this.camera);
    countFrame(this.renderer.info, early);
    this.markEnd();
    const followed = this.followed ?? -1;
    this.labels?.show(this.camera, this.size, this.fleet.object.visible, followed, this.through ? followed : -1);
  }

  /** Adds a fence to the commands of the graphics driver, which signals that the picture is finished. */
  markEnd() {
    const gl = this.renderer.getContext();
    gl.deleteSync(this.mark ?? null);
    this.mark = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
  }

  /** Whether the last picture is finished. Drawing before that would block the page. */
  isFinished() {
    const gl = this.renderer.getContext();
    if (!this.mark || gl.isContextLost()) return true;
    return gl.getSyncParameter(this.mark, gl.SYNC_STATUS) !== gl.UNSIGNALED;
  }

  /** @returns the objects below the pointer, nearest first. */
  hits(event, objects) {
    const {left, top, width, height} = this.renderer.domElement.getBoundingClientRect();
    const ray = new THREE.Raycaster();
    ray.setFromCamera(
        new THREE.Vector2(((event.clientX - left) / width) * 2 - 1, 1 - ((event.clientY - top) / height) * 2),
        this.camera);
    return ray.intersectObjects(objects.filter((object) => object.visible));
  }

  /** Shows a tip about the point below the pointer. */
  point(event) {
    if (event.buttons !== 0 || points.length === 0) return;
    const hit = this.hits(event, [this.structure])[0];
    this.tip.hidden = hit === undefined;
    if (hit === undefined) return;
    const p = points[hit.instanceId];
    if (data.describe) {
      this.tip.textContent = data.describe(hit.instanceId, moment.seconds);
      return;
    }
    const parts = [`point ${hit.instanceId}`, `score ${p.score.toFixed(3)}`];
    if (data.causes_known)
      parts.push(
          `attainable ${p.estimate.toFixed(3)}`, p.cause < 0 ? 'nothing lost' : `lost: ${data.causes[p.cause]}`);
    if (p.uav >= 0) parts.push(`by ${data.uavs[p.uav].name} at ${p.taken.toFixed(1)} s`);
    this.tip.textContent = parts.join(' · ');
  }
}
