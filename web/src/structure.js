// The objects of the scene that do not change: the structure, drawn as its interest points, and the boxes.
import * as THREE from 'three';

import {data} from './page.js';
import {points, tracks} from './points.js';

/**
 * @returns a radius with which discs at the points look like a surface: 0.8 times the median distance of neighbours
 * [m].
 */
function discRadius() {
  const distances = [];
  for (let k = 0; k < Math.min(points.length, 60); ++k) {
    const from = points[Math.floor((k * points.length) / 60) % points.length];
    let least = Infinity;
    for (const other of points)
      if (other !== from) least = Math.min(least, from.p.distanceToSquared(other.p));
    if (Number.isFinite(least)) distances.push(Math.sqrt(least));
  }
  distances.sort((a, b) => a - b);
  return Math.min(Math.max(0.8 * (distances[distances.length >> 1] ?? 0.5), 0.12), 1.2);
}

/** @returns discs, one at each interest point. */
export function makeStructure() {
  const mesh = new THREE.InstancedMesh(
      new THREE.CircleGeometry(discRadius(), 10), new THREE.MeshLambertMaterial({side: THREE.DoubleSide}), points.length);
  const along = new THREE.Vector3(0, 0, 1);
  const turn = new THREE.Quaternion();
  const unit = new THREE.Vector3(1, 1, 1);
  points.forEach(({p, n}, i) => {
    turn.setFromUnitVectors(along, n.lengthSq() > 0.5 ? n.clone().normalize() : along);
    mesh.setMatrixAt(i, new THREE.Matrix4().compose(p, turn, unit));
  });
  return mesh;
}

/** @returns the edges of all boxes. */
export function makeBoxes() {
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

/** @returns the box around points, boxes and station; if there are neither points nor boxes, also around the tracks. */
export function bounds() {
  const box = new THREE.Box3();
  for (const {p} of points) box.expandByPoint(p);
  for (const corners of data.boxes)
    for (const c of corners) box.expandByPoint(new THREE.Vector3(...c).multiplyScalar(0.01));
  if (box.isEmpty())
    for (const t of tracks) t.t.forEach((_, i) => box.expandByPoint(new THREE.Vector3(t.x[i], t.y[i], t.z[i])));
  if (data.station) box.expandByPoint(new THREE.Vector3().fromArray(data.station).multiplyScalar(0.01));
  if (box.isEmpty()) box.expandByPoint(new THREE.Vector3());
  return box;
}
