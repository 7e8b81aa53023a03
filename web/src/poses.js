// Where something is between two of its recorded poses.
import {indexAt} from './page.js';

/** The shorter way from one angle to another. */
const turned = (from, to, share) => from + share * Math.atan2(Math.sin(to - from), Math.cos(to - from));

/** @param track  columns t, x, y, z, yaw, pitch. @returns null before the first of them; `at`: the last one that is over. */
export function poseOn(track, time) {
  const at = indexAt(track.t, time);
  if (at < 0) return null;
  const next = Math.min(at + 1, track.t.length - 1);
  const share = next > at ? Math.min((time - track.t[at]) / (track.t[next] - track.t[at]), 1) : 0;
  const between = (values) => values[at] + share * (values[next] - values[at]);
  return {
    x: between(track.x), y: between(track.y), z: between(track.z),
    yaw: turned(track.yaw[at], track.yaw[next], share), pitch: between(track.pitch), at, next,
  };
}
