// The flight inside a self-contained page (skein replay --export). The page receives it in the same form as from a
// server.

/** @param text  base64 of a zlib stream. @returns the UTF-8 text in it. */
export async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text.trim()), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'))).text();
}

/**
 * Removes controls of data that the page does not contain, and adds a note about them to the scene.
 * @param kept  {lidar, maps}: whether the page contains them (view/kept_flight.hpp); undefined: neither, without a
 * note.
 */
function tellWhatIsKept(scene, kept) {
  if (!kept) delete scene.clouds;
  if (!scene.clouds) return;
  const names = {lidar: 'LiDAR points', maps: 'Maps'};
  for (const kind of Object.keys(names)) {
    if (kept[kind] || scene.clouds[kind].length === 0) continue;
    scene.clouds[kind] = [];
    scene.clouds.missing = `${scene.clouds.missing} ${names[kind]} would make this file too large: skein replay shows them.`.trim();
  }
}

/** @param holder  the element with the flight. @param use  as of connect(). @returns a function that takes orders. */
export function tellKept(holder, use) {
  const text = holder.textContent;
  const clouds = new Map();  // points and maps that were not requested yet, by name
  holder.remove();
  unpacked(text).then((json) => {
    const told = JSON.parse(json);
    for (const cloud of told.clouds ?? []) clouds.set(cloud.n, cloud);
    tellWhatIsKept(told.scene, told.kept);
    use.scene(told.scene);
    use.lines(told.lines, false);
  });
  return (order) => {
    if (order.do !== 'look') return;
    const asked = [...(order.lidar ?? []).map((uav) => `lidar ${uav}`), `map ${order.map}`].filter((name) => clouds.has(name));
    const found = asked.map((name) => clouds.get(name));
    for (const name of asked) clouds.delete(name);
    if (found.length > 0) use.clouds(found);
  };
}
