// The reader's viewpoint, in the page's address: positions of eye and target in W [m].
let scene = null;
let turned = false;  // by the reader; before that, the address does not contain the viewpoint

/** @param shown  the scene; undefined: there is none, without WebGL. */
export function watchEye(shown) {
  scene = shown ?? null;
  scene?.controls.addEventListener('end', () => (turned = true));
}

/** Writes the viewpoint. @param words  of the address. */
export function writeEye(words) {
  if (!turned || scene.followed >= 0) return;  // a view that follows a UAV depends on the UAV's position
  const numbers = [...scene.camera.position.toArray(), ...scene.controls.target.toArray()];
  words.set('eye', numbers.map((metres) => metres.toFixed(1)).join(','));
}

/** Moves the view to the viewpoint in the address, if there is one. */
export function readEye() {
  const numbers = new URLSearchParams(location.hash.slice(1)).get('eye')?.split(',').map(Number) ?? [];
  if (scene === null || numbers.length !== 6 || !numbers.every(Number.isFinite)) return;
  scene.camera.position.fromArray(numbers);
  scene.controls.target.fromArray(numbers, 3);
  scene.controls.update();
  turned = true;
}
