// Unpacks LiDAR points and the cubes of maps as the server sends them (view/scan_points.hpp, view/cube_runs.hpp).

const bytesOf = (text) => Uint8Array.from(atob(text), (digit) => digit.charCodeAt(0));

/** @returns x, y, z of each point [m], one point after the other. */
export function unpackedPoints(text) {
  const bytes = bytesOf(text);
  const view = new DataView(bytes.buffer);
  return Float32Array.from({length: bytes.length >> 1}, (_, i) => view.getInt16(2 * i, true) / 10);
}

/** @returns for each row x, y, z of its first cube [cubes] and its number of cubes, one row after the other. */
export function unpackedRuns(text) {
  const bytes = bytesOf(text);
  let at = 0;
  const next = () => {
    let value = 0;
    for (let shift = 0;; shift += 7) {
      const byte = bytes[at++];
      value |= (byte & 127) << shift;
      if (byte < 128) return value;
    }
  };
  const nextSigned = () => {
    const value = next();
    return (value >> 1) ^ -(value & 1);
  };
  const runs = [];
  let [x, y, z, length] = [0, 0, 0, 0];
  while (at < bytes.length) {
    const head = next();
    if (head & 1) {
      x += length + next();
    } else {
      z += nextSigned();
      y += nextSigned();
      x += nextSigned();
    }
    length = (head >> 1) + 1;
    runs.push(x, y, z, length);
  }
  return runs;
}
