// Interpolates between recorded poses.
import {indexAt} from './page.js';

/** Interpolates between two angles, along the shorter way. */
const turned = (from, to, share) => from + share * Math.atan2(Math.sin(to - from), Math.cos(to - from));

/**
 * @param track  columns t, x, y, z, yaw, pitch.
 * @returns the pose; `at`: index of the last pose before it. null: too early.
 */
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
