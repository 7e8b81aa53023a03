// The fleet's bodies, the station and collisions: one draw call for each shape, however many bodies there are.
import * as THREE from 'three';

import {colour, data, trackColour} from './page.js';

const kNowhere = new THREE.Matrix4().makeScale(0, 0, 0);

/** Many bodies of one shape, each with a place and a colour. */
class Shapes {
  constructor(geometry, most, material = new THREE.MeshLambertMaterial()) {
    this.object = new THREE.InstancedMesh(geometry, material, Math.max(most, 1));
    this.object.frustumCulled = false;
    this.object.count = most;
    this.at = new THREE.Matrix4();
    for (let i = 0; i < most; ++i) this.object.setMatrixAt(i, kNowhere);
  }

  /** @param position  null: the body is not drawn. */
  put(i, position) {
    this.object.setMatrixAt(i, position === null ? kNowhere : this.at.makeTranslation(position));
  }

  tint(i, name) {
    this.object.setColorAt(i, new THREE.Color(colour(name)));
  }

  end() {
    this.object.instanceMatrix.needsUpdate = true;
    this.object.boundingSphere = null;  // recomputed at the next search for the body below the pointer
    if (this.object.instanceColor) this.object.instanceColor.needsUpdate = true;
  }
}

/**
 * UAVs: explorers have edges, and the UAVs of a second run are hollow. `bodies`: position of each UAV, and whether it
 * is shown.
 */
export class Fleet {
  constructor() {
    this.bodies = data.uavs.map(() => ({position: new THREE.Vector3(), visible: false}));
    const make = (geometry, explorer, run) => {
      const isOne = (uav) => Boolean(uav.explorer) === explorer && (uav.run ?? 0) === run;
      const members = data.uavs.flatMap((uav, i) => (isOne(uav) ? [i] : []));
      const material = run > 0 ? new THREE.MeshBasicMaterial({wireframe: true}) : undefined;
      return {members, shapes: new Shapes(geometry, members.length, material)};
    };
    this.kinds = [
      make(new THREE.OctahedronGeometry(1.1), true, 0), make(new THREE.SphereGeometry(0.8, 20, 14), false, 0),
      make(new THREE.OctahedronGeometry(1.1), true, 1), make(new THREE.SphereGeometry(0.8, 8, 6), false, 1)
    ].filter(({members}) => members.length > 0);
    this.object = new THREE.Group().add(...this.kinds.map(({shapes}) => shapes.object));
  }

  /** Call it after `bodies` have changed. */
  update() {
    for (const {members, shapes} of this.kinds) {
      members.forEach((uav, i) => shapes.put(i, this.bodies[uav].visible ? this.bodies[uav].position : null));
      shapes.end();
    }
  }

  paint() {
    for (const {members, shapes} of this.kinds) {
      members.forEach((uav, i) => shapes.tint(i, trackColour(uav)));
      shapes.end();
    }
  }

  /** @returns the UAV that a ray has hit; -1: the ray has hit something else. */
  uavOf({object, instanceId}) {
    return this.kinds.find(({shapes}) => shapes.object === object)?.members[instanceId] ?? -1;
  }

  get targets() {
    return this.object.visible ? this.kinds.map(({shapes}) => shapes.object) : [];
  }
}

/**
 * The station, and the places of collisions: those in the page's data, and those of UAVs in a flight that arrives as
 * lines.
 */
export class Marks {
  constructor() {
    this.station = new Shapes(new THREE.ConeGeometry(1.2, 3, 20).rotateX(Math.PI / 2), data.station ? 1 : 0);
    if (data.station) this.station.put(0, new THREE.Vector3().fromArray(data.station).multiplyScalar(0.01));
    this.station.end();
    this.crashes = new Shapes(new THREE.IcosahedronGeometry(1.3), data.collisions.length + data.uavs.length);
    data.collisions.forEach((place, i) => this.crashes.put(i, new THREE.Vector3().fromArray(place).multiplyScalar(0.01)));
    this.crashes.end();
    this.object = new THREE.Group().add(this.station.object, this.crashes.object);
    this.shown = '';
  }

  paint() {
    if (data.station) this.station.tint(0, 'ink');
    for (let i = 0; i < this.crashes.object.count; ++i) this.crashes.tint(i, 'bad');
    this.station.end();
    this.crashes.end();
  }

  show(seconds) {
    if (!data.poseAt) return;
    const crashed = data.uavs.map(({collided}) => (collided !== null && collided <= seconds ? collided : null));
    const key = crashed.join();
    if (key === this.shown) return;
    this.shown = key;
    crashed.forEach((time, uav) => {
      const pose = time === null ? null : data.poseAt(uav, time, false);
      this.crashes.put(data.collisions.length + uav, pose === null ? null : new THREE.Vector3(pose.x, pose.y, pose.z));
    });
    this.crashes.end();
  }
}
