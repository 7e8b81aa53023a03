// Gives the cameras and links of a report's data the interface of a flight (flight.js), so that a report and the page
// that follows a run have the same scene.
import {data, element, indexAt, track} from './page.js';
import {poseOn} from './poses.js';

/** Call it before the scene is made. */
export function offerFlight() {
  const tracks = data.uavs.map(track);
  data.poseAt = (uav, time) => {
    const pose = poseOn(tracks[uav], time);
    const {collided} = data.uavs[uav];
    return pose && {...pose, alive: collided === null || time < collided};
  };
  for (const uav of data.uavs) Object.assign(uav, uav.camera);
  if (!data.links) return;
  data.linksAt = (time) => {
    const at = indexAt(data.links.t, 1000 * time);
    return at < 0 ? '' : data.links.l[at];
  };
}

/** Adds controls: the UAV that the view follows, and whether the view is that of its camera. */
export function followTools(scene) {
  const whom = element('select', {id: 'follow', 'aria-label': 'whom the view follows'}, element('option', {value: '-1'}, 'no UAV'),
                       ...data.uavs.map(({name}, i) => element('option', {value: String(i)}, name)));
  const through = element('input', {type: 'checkbox', id: 'through'});
  through.disabled = true;
  const follow = () => {
    const uav = Number(whom.value);
    through.disabled = uav < 0 || !(data.uavs[uav].vfov > 0);
    if (through.disabled) through.checked = false;
    scene.follow(uav, through.checked);
  };
  for (const control of [whom, through]) control.addEventListener('change', follow);
  scene.stage.parentElement.querySelector('.tools')
      .append(element('label', {}, 'Follow', whom), element('label', {}, through, 'through its camera'));
}
