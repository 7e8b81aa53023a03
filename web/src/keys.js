// Keyboard control of the scene: arrows turn it, + and - zoom, 0 restores the first view.
import * as THREE from 'three';

const kTurn = Math.PI / 24;
const kNearer = 1.15;
const kTurns = {ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};

/** @param home  restores the first view */
export function takeKeys(canvas, camera, controls, home) {
  canvas.tabIndex = 0;
  canvas.setAttribute('role', 'application');
  canvas.setAttribute('aria-label', 'the scene: arrow keys turn it, plus and minus zoom, 0 resets the view');
  const toZ = new THREE.Quaternion().setFromUnitVectors(camera.up, new THREE.Vector3(0, 1, 0));
  canvas.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || !controls.enabled) return;
    const turn = kTurns[event.key];
    const zoom = {'+': 1 / kNearer, '=': 1 / kNearer, '-': kNearer}[event.key];
    if (turn === undefined && zoom === undefined && event.key !== '0') return;
    event.preventDefault();
    if (event.key === '0') return home();
    const offset = camera.position.clone().sub(controls.target).applyQuaternion(toZ);
    const around = new THREE.Spherical().setFromVector3(offset);
    if (turn) {
      around.theta += turn[0] * kTurn;
      around.phi = Math.min(Math.max(around.phi + turn[1] * kTurn, 0.05), Math.PI - 0.05);
    }
    around.radius *= zoom ?? 1;
    camera.position.copy(controls.target)
        .add(new THREE.Vector3().setFromSpherical(around).applyQuaternion(toZ.clone().invert()));
    controls.update();
  });
}
