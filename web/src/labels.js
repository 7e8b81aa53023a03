// Names of the UAVs in the scene. If two names would overlap, only that of the nearer UAV is shown.
import * as THREE from 'three';

import {colour, data, element, shortName, trackColour} from './page.js';

const kGap = 2;  // pixels

export class Labels {
  /** @param bodies  of the UAVs: {position, visible} */
  constructor(stage, bodies) {
    this.bodies = bodies;
    this.tags = data.uavs.map(({name}) => element('span', {class: 'tag', 'aria-hidden': 'true'}, shortName(name, 18)));
    this.places = this.tags.map(() => ({width: 0, height: 0, x: 0, y: 0, depth: 2, shown: null}));
    stage.append(...this.tags);
    this.at = new THREE.Vector3();
  }

  paint() {
    this.tags.forEach((tag, uav) => (tag.style.color = colour(trackColour(uav))));
  }

  measure() {
    this.tags.forEach((tag, uav) => {
      if (this.places[uav].width > 0) return;
      tag.style.visibility = 'hidden';
      Object.assign(this.places[uav], {width: tag.offsetWidth, height: tag.offsetHeight, shown: false});
    });
  }

  /** @param first  a UAV whose name has priority; -1: none. @param without  a UAV whose name is hidden; -1: none. */
  show(camera, {width, height}, on, first, without) {
    this.measure();
    const order = [];
    this.bodies.forEach((body, uav) => {
      const place = this.places[uav];
      const at = this.at.copy(body.position).project(camera);
      place.depth = uav === first ? -2 : at.z;
      // To the right of the body, or to the left if it does not fit on the right.
      const x = ((at.x + 1) / 2) * width;
      place.x = Math.round(x + 9 + place.width > width && x - 9 - place.width > 0 ? x - 9 - place.width : x + 9);
      place.y = Math.round(((1 - at.y) / 2) * height - 18);
      const there = on && body.visible && uav !== without && at.z < 1 && Math.abs(at.x) < 1.05 && Math.abs(at.y) < 1.05;
      if (there) order.push(uav);
      else this.set(uav, false);
    });
    order.sort((a, b) => this.places[a].depth - this.places[b].depth);
    const taken = [];
    for (const uav of order) {
      const one = this.places[uav];
      const free = taken.every((other) => one.x > other.x + other.width + kGap || other.x > one.x + one.width + kGap ||
          one.y > other.y + other.height + kGap || other.y > one.y + one.height + kGap);
      if (free) taken.push(one);
      this.set(uav, free);
    }
  }

  set(uav, shown) {
    const place = this.places[uav];
    const {style} = this.tags[uav];
    if (place.shown !== shown) style.visibility = shown ? 'visible' : 'hidden';
    place.shown = shown;
    style.transform = `translate(${place.x}px, ${place.y}px)`;
  }
}
