// The interest points and the tracks of the flight, read from the page's data when this module is loaded: live.js
// loads it, through scene_view.js, once the data have arrived.
import * as THREE from 'three';

import {kDetected} from './custody.js';
import {data, track} from './page.js';

const kPerPoint = 9;  // numbers per point in the data
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
export const points = Array.from({length: count}, (_, i) => point(i));
export const tracks = data.uavs.map(track);

/** @returns the name of the colour of a point with this score. */
export const scoreColour = (score) =>
    score < kDetected ? 'q0' : `q${1 + Math.min(Math.floor(((score - kDetected) / (1 - kDetected)) * 4), 3)}`;
