// All trails of a fleet in one draw call: segments ordered by time, which are drawn up to the moment that the page
// shows. If there are two fleets, the trails of the second one are dashed.
import * as THREE from 'three';
import {LineMaterial} from 'three/addons/lines/LineMaterial.js';
import {LineSegments2} from 'three/addons/lines/LineSegments2.js';
import {LineSegmentsGeometry} from 'three/addons/lines/LineSegmentsGeometry.js';

import {colour, data, indexAt, trackColour} from './page.js';

const kLeastRoom = 1024;

class Trails {
  /** @param tracks  of the UAVs; on the page that follows a run, they grow. @param uavs  their numbers on the page. */
  constructor(tracks, uavs, dashed) {
    this.tracks = tracks;
    this.uavs = uavs;
    this.dashed = dashed;
    this.colours = tracks.map(() => new THREE.Color());
    this.object = new LineSegments2(
        new LineSegmentsGeometry(),
        new LineMaterial({linewidth: 1.7, vertexColors: true, transparent: true, opacity: 0.55, dashed, dashSize: 0.7, gapSize: 0.6}));
    this.object.frustumCulled = false;
    this.clear();
    this.makeRoom(kLeastRoom);
    this.grow();
  }

  clear() {
    this.filled = this.tracks.map(() => 0);  // number of segments by UAV
    this.ends = [];                          // by segment: its end [s]
    this.whose = [];
    this.thinned = this.tracks[0]?.thinned;
  }

  makeRoom(segments) {
    this.room = segments;
    this.object.geometry.dispose();
    this.object.geometry = new LineSegmentsGeometry();
    this.object.geometry.setPositions(new Float32Array(6 * segments));
    this.object.geometry.setColors(new Float32Array(6 * segments));
    const {instanceStart, instanceColorStart} = this.object.geometry.attributes;
    this.places = instanceStart.data;
    this.paints = instanceColorStart.data;
  }

  /** Adds segments for the new parts of the tracks; begins anew if the tracks were thinned. */
  grow() {
    if (this.thinned !== this.tracks[0]?.thinned) this.clear();
    const fresh = [];
    this.tracks.forEach(({t}, uav) => {
      for (let i = this.filled[uav]; i + 1 < t.length; ++i) fresh.push([t[i + 1], uav, i]);
    });
    if (fresh.length === 0) return;
    fresh.sort((a, b) => a[0] - b[0] || a[1] - b[1]);
    const needed = this.ends.length + fresh.length;
    if (needed > this.room) {
      this.clear();
      this.makeRoom(2 * needed);
      this.grow();
      return;
    }
    const from = this.ends.length;
    for (const [end, uav, i] of fresh) {
      const {x, y, z} = this.tracks[uav];
      this.places.array.set([x[i], y[i], z[i], x[i + 1], y[i + 1], z[i + 1]], 6 * this.ends.length);
      this.tint(this.ends.length, this.colours[uav]);
      this.ends.push(end);
      this.whose.push(uav);
      this.filled[uav] = i + 1;
    }
    for (const buffer of [this.places, this.paints]) {
      buffer.addUpdateRange(6 * from, 6 * fresh.length);
      buffer.needsUpdate = true;
    }
    if (this.dashed) this.object.computeLineDistances();
  }

  tint(segment, {r, g, b}) {
    this.paints.array.set([r, g, b, r, g, b], 6 * segment);
  }

  paint() {
    this.colours.forEach((its, uav) => its.set(colour(trackColour(this.uavs[uav]))));
    this.whose.forEach((uav, segment) => this.tint(segment, this.colours[uav]));
    this.paints.clearUpdateRanges();
    this.paints.needsUpdate = true;
  }

  /** @param isThere  tells whether a UAV of the page is drawn. The trails are hidden if no UAV of their fleet is. */
  showUntil(seconds, isThere) {
    this.grow();
    const count = indexAt(this.ends, seconds) + 1;
    this.object.geometry.instanceCount = count;
    this.object.visible = count > 0 && this.uavs.some(isThere);
  }
}

/** @returns the trails of each run of the page. @param tracks  by UAV of the page. */
export function trailsOfRuns(tracks) {
  const runs = [...new Set(data.uavs.map(({run}) => run ?? 0))];
  return runs.map((of) => {
    const uavs = data.uavs.flatMap(({run}, uav) => ((run ?? 0) === of ? [uav] : []));
    return new Trails(uavs.map((uav) => tracks[uav]), uavs, of > 0);
  });
}
