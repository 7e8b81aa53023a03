// Draws data of a flight into the scene: the fields of view of cameras, and the radio links.
import * as THREE from 'three';
import {LineMaterial} from 'three/addons/lines/LineMaterial.js';
import {LineSegments2} from 'three/addons/lines/LineSegments2.js';
import {LineSegmentsGeometry} from 'three/addons/lines/LineSegmentsGeometry.js';

import {colour, data, moment, trackColour} from './page.js';

export const kDashes = 24;  // greatest number of dashes of a line
const kDash = 1.6;          // m; length of a dash, and of a gap

/** Line segments, each with its own colour, in one draw call. @param room  greatest number of segments. */
export class Segments {
  constructor(room, width, opacity) {
    this.geometry = new LineSegmentsGeometry();
    this.geometry.setPositions(new Float32Array(6 * room));
    this.geometry.setColors(new Float32Array(6 * room));
    this.object = new LineSegments2(
        this.geometry, new LineMaterial({linewidth: width, vertexColors: true, transparent: true, opacity}));
    this.object.frustumCulled = false;
    this.count = 0;
  }

  begin() {
    this.count = 0;
  }

  add(from, to, {r, g, b}) {
    const at = 6 * this.count++;
    this.geometry.attributes.instanceStart.data.array.set([from.x, from.y, from.z, to.x, to.y, to.z], at);
    this.geometry.attributes.instanceColorStart.data.array.set([r, g, b, r, g, b], at);
  }

  /** Adds a dashed line: at most kDashes segments. @param share  part of the line that is drawn. */
  addDashed(from, to, shade, share = 0.5) {
    const way = to.clone().sub(from);
    const dashes = Math.min(Math.ceil(way.length() / (2 * kDash)), kDashes);
    for (let i = 0; i < dashes; ++i)
      this.add(from.clone().addScaledVector(way, i / dashes), from.clone().addScaledVector(way, (i + share) / dashes), shade);
  }

  end() {
    this.geometry.attributes.instanceStart.data.needsUpdate = true;
    this.geometry.attributes.instanceColorStart.data.needsUpdate = true;
    this.geometry.instanceCount = this.count;
  }
}

/** The field of view of each camera, up to the range in which it sees sharply enough: a pyramid. */
export function makeFrusta() {
  const segments = new Segments(8 * data.uavs.length, 1.2, 0.75);
  let colours = [];
  const corners = ({yaw, pitch, ...p}, {hfov, vfov, range}) => {
    const [cy, sy, cp, sp] = [Math.cos(yaw), Math.sin(yaw), Math.cos(pitch), Math.sin(pitch)];
    const ahead = new THREE.Vector3(cp * cy, cp * sy, -sp);
    const left = new THREE.Vector3(-sy, cy, 0);
    const up = new THREE.Vector3(sp * cy, sp * sy, cp);
    const [y, z] = [hfov, vfov].map((degrees) => Math.tan((degrees * Math.PI) / 360));
    return [[1, 1], [-1, 1], [-1, -1], [1, -1]].map(
        ([l, u]) => ahead.clone()
                        .addScaledVector(left, l * y)
                        .addScaledVector(up, u * z)
                        .setLength(range)
                        .add(new THREE.Vector3(p.x, p.y, p.z)));
  };
  return {
    object: segments.object,
    paint: () => (colours = data.uavs.map((_, uav) => new THREE.Color(colour(trackColour(uav))))),
    show(seconds) {
      segments.begin();
      data.uavs.forEach((uav, i) => {
        const pose = data.poseAt(i, seconds, moment.newest);
        if (pose === null || !pose.alive) return;
        const ends = corners(pose, uav);
        ends.forEach((end, k) => {
          segments.add(pose, end, colours[i]);
          segments.add(end, ends[(k + 1) % 4], colours[i]);
        });
      });
      segments.end();
    },
  };
}

/**
 * Draws the open links and those that a fault cuts. Of the blocked and dead links, only those of the followed UAV are
 * drawn, because all of them would hide the scene.
 * @param followed  returns the followed UAV; -1: none.
 */
export function makeLinks(bodies, followed) {
  const nodes = bodies.length + 1;
  const segments = new Segments((nodes * (nodes - 1)) / 2 + nodes * kDashes, 2.0, 0.85);
  const station = new THREE.Vector3().fromArray(data.station ?? [0, 0, 0]).multiplyScalar(0.01);
  const place = (node) => (node === 0 ? station : bodies[node - 1].position);
  let colours = {};
  return {
    object: segments.object,
    paint: () => (colours = {
      linked: new THREE.Color(colour('direct')),
      relayed: new THREE.Color(colour('relayed')),
      cut: new THREE.Color(colour('bad')),
      none: new THREE.Color(colour('soft')),
    }),
    show(seconds) {
      const digits = data.linksAt(seconds);
      const own = data.runs ? 0 : followed() + 1;  // of two flights, no link leads from one to the other
      segments.begin();
      for (let from = 0; digits !== '' && from < nodes; ++from) {
        for (let to = from + 1; to < nodes; ++to) {
          const both = digits[from * nodes + to] + digits[to * nodes + from];
          if (both.includes('2'))
            segments.add(place(from), place(to), colours.cut);
          else if (both.includes('1'))
            segments.add(place(from), place(to), from === 0 ? colours.linked : colours.relayed);
          else if (own > 0 && (from === own || to === own))
            segments.addDashed(place(from), place(to), colours.none, both.includes('3') ? 0.12 : 0.5);
        }
      }
      segments.end();
    },
  };
}
