// From where the reader looks at the scene, as the page's address holds it: eye and target, in metres.
let scene = null;
let turned = false;  // by the reader: before that the address need not hold it

/** @param shown  undefined where there is no WebGL. */
export function watchEye(shown) {
  scene = shown ?? null;
  scene?.controls.addEventListener('end', () => (turned = true));
}

/** @param words  of the address. */
export function writeEye(words) {
  if (!turned || scene.followed >= 0) return;  // who follows a UAV looks from wherever it is
  const numbers = [...scene.camera.position.toArray(), ...scene.controls.target.toArray()];
  words.set('eye', numbers.map((metres) => metres.toFixed(1)).join(','));
}

/** Looks from where the address says, if it does. */
export function readEye() {
  const numbers = new URLSearchParams(location.hash.slice(1)).get('eye')?.split(',').map(Number) ?? [];
  if (scene === null || numbers.length !== 6 || !numbers.every(Number.isFinite)) return;
  scene.camera.position.fromArray(numbers);
  scene.controls.target.fromArray(numbers, 3);
  scene.controls.update();
  turned = true;
}
