// Window with the gears: camera, light and labels. It is drawn only after changes.
import { ACESFilmicToneMapping, DirectionalLight, HemisphereLight, PerspectiveCamera, Scene, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { Differential } from "./differential.js";
import { studio } from "./steel.js";
import { clamp } from "./table.js";

const MARGIN = 44; // minimum distance of a label's middle from the window's edge in pixels
const ANGLE = 26; // vertical angle of view in degrees
const FINEST = 2; // maximum number of picture pixels per page pixel, in one direction
const WIDE = 1.65; // half length of the axle that fits into the view of the whole, per reach of the gears
const COARSE = 5e4; // maximum number of pixels if the processor draws

// Seen from the rear of a vehicle, with +x, its left, at the left.
// `from` is the position of the eye in axes of the scene. With `at`, it is in axes of the left mesh of planet 1: along
// its pitch line, forward, away from the planet. `at` is the target along the pitch line; lengths are relative to the
// reach of the gears.
// With a final drive, `around` replaces `from`, and the distance is `far` times the radius of the sphere around its gears.
// With `mesh`, the eye is in axes of its mesh: along the pitch line, from the pinion to the ring gear, upward. The distance
// is then `far` times the radius of the ring gear. Views of one mesh are `alone`, because the ring gear would cover it.
export const PRESETS = {
  whole: { from: [-0.3, 0.46, -1], distance: 5.9, hold: false, shell: true, arrows: 0.7, around: [-0.45, 0.8, -1], far: 4 },
  mesh: { from: [0.75, -0.28, 0.1], at: 0.92, distance: 1.9, hold: true, shell: false, arrows: 0.35, alone: true },
  side: { from: [1, 0.12, -0.1], distance: 6.2, hold: false, shell: false, arrows: 0.7, around: [1, 0.12, -0.1], far: 4.4 },
  flank: { from: [0.5, -0.7, 0.6], at: 0.8, distance: 1.8, hold: true, shell: false, arrows: 0, through: true, alone: true },
  drive: { from: [-0.3, 0.46, -1], distance: 5.9, hold: false, shell: true, arrows: 0.7, mesh: [1, 0.1, 0.6], far: 2.6 },
};

export class View {
  // `isFine` draws every pixel even if the processor draws, for pictures that are saved.
  constructor(canvas, labels, isFine) {
    this.canvas = canvas;
    this.isCoarse = !isFine && isDrawnByProcessor();
    this.renderer = new WebGLRenderer({ canvas, antialias: !this.isCoarse, alpha: true });
    this.renderer.toneMapping = ACESFilmicToneMapping;
    this.renderer.toneMappingExposure = 1.1;
    this.scene = new Scene();
    if (this.isCoarse) {
      // mirrored light takes more than half of a picture's time if the processor draws
      this.scene.add(new HemisphereLight("#ffffff", "#8a8078", 1.5));
    } else {
      this.scene.environment = studio(this.renderer);
      this.scene.environmentIntensity = 0.7;
    }
    const key = new DirectionalLight("#fff4e4", 1.8);
    key.position.set(-0.6, 1.2, -0.9);
    // a lamp next to the eye, so that no visible face is black
    this.lamp = new DirectionalLight("#ffffff", 0.9);
    this.scene.add(key, this.lamp);
    this.camera = new PerspectiveCamera(ANGLE, 1, 1, 10000);
    this.orbit = new OrbitControls(this.camera, canvas);
    this.orbit.enableDamping = true;
    this.orbit.addEventListener("change", () => { this.stale = true; });
    this.differential = new Differential();
    this.scene.add(this.differential.group, this.differential.still);
    // the shader programs are compiled while the library is loaded
    this.renderer.compile(this.scene, this.camera);
    this.labels = labels;
    this.preset = "whole";
    new ResizeObserver(() => this.fit()).observe(canvas.parentElement);
  }

  // Replaces the gears, as `Differential.build` does. The eye moves if the size of the picture or its position changes.
  build(surfaces, geometry) {
    const before = this.differential.gears && this.sight();
    this.differential.build(surfaces, geometry);
    const now = this.sight();
    const isSame = before && Math.abs(before.size / now.size - 1) < 0.05 && before.direction.angleTo(now.direction) < 0.1
      && before.target.distanceTo(now.target) < 0.1 * now.size;
    if (!isSame || PRESETS[this.preset].at) this.look(this.preset);
    this.stale = true;
  }

  look(name) {
    this.preset = name;
    if (!this.differential.reach) return;
    const { at, hold, shell, arrows, through, alone } = PRESETS[name];
    this.hold = hold;
    this.showCase(shell);
    this.differential.showDrive(!alone);
    this.differential.showThrough(Boolean(through));
    this.differential.arrowLength = arrows;
    const { target, direction, size } = this.sight();
    // in a narrow window, the eye is farther away
    const wide = Math.max(1, (at ? 0.9 : 1.45) / this.camera.aspect);
    this.camera.position.copy(direction).multiplyScalar(size * wide).add(target);
    this.orbit.target.copy(target);
    this.orbit.update();
    this.stale = true;
  }

  // Target of the present view, direction from there to the eye, and distance of the eye.
  sight() {
    const { reach, end, assembly, drive } = this.differential;
    const { from, at, distance, around, mesh, far } = PRESETS[this.preset];
    const along = (axes, parts) => axes.reduce((sum, axis, k) => sum.addScaledVector(axis, parts[k]), new Vector3()).normalize();
    if (at) {
      const { line, forward, apart } = assembly.axes(0, 1, 0);
      return { target: line.clone().multiplyScalar(at * reach), direction: along([line, forward, apart], from), size: distance * reach };
    }
    if (drive && mesh) {
      const { line, toMesh, above, pitchPoint, ringCentre } = drive.place;
      return { target: pitchPoint, direction: along([line, toMesh, above], mesh), size: far * pitchPoint.distanceTo(ringCentre) };
    }
    if (drive && around) {
      const [target, radius] = drive.bounds;
      const [x, y, z] = around;
      // the view of the whole is from the side of the planets, so that the ring gear does not cover them
      const beside = this.preset === "whole" ? x * drive.place.side : x;
      return { target, direction: new Vector3(beside, y, z).normalize(), size: far * Math.max(radius, 1.5 * reach, 1.06 * end) };
    }
    // clutches make the half-shafts longer
    return { target: new Vector3(), direction: new Vector3(...from).normalize(), size: distance * Math.max(reach, end / WIDE) };
  }

  showCase(visible) {
    this.differential.showCase(visible);
    this.stale = true;
  }

  // Moves the eye around the gears by angles [rad].
  turn(around, up) {
    const offset = this.camera.position.clone().sub(this.orbit.target);
    offset.applyAxisAngle(this.camera.up, around);
    const side = new Vector3().crossVectors(offset, this.camera.up).normalize();
    const raised = offset.clone().applyAxisAngle(side, up);
    if (raised.angleTo(this.camera.up) > 0.1 && raised.angleTo(this.camera.up) < 3.04) offset.copy(raised);
    this.camera.position.copy(this.orbit.target).add(offset);
    this.orbit.update();
  }

  fit() {
    const { clientWidth, clientHeight } = this.canvas.parentElement;
    if (clientWidth === 0 || clientHeight === 0) return;
    const before = this.camera.aspect;
    const finest = this.isCoarse ? Math.min(Math.sqrt(COARSE / (clientWidth * clientHeight)), 1) : FINEST;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, finest));
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    const [x, y] = this.aside ?? [0, 0];
    this.camera.setViewOffset(clientWidth, clientHeight, -x * clientWidth, -y * clientHeight, clientWidth, clientHeight);
    if (Math.abs(before - this.camera.aspect) > 0.2) this.look(this.preset);
    this.stale = true;
  }

  // Shifts the picture by fractions of the window, away from panels that cover it.
  shift(x, y) {
    this.aside = [x, y];
    this.fit();
  }

  pose(record, largest, colours, pressed) {
    this.differential.pose(record, largest, colours, this.hold ? record.value("carrier.angle") : 0, pressed);
    this.stale = true;
  }

  draw() {
    this.orbit.update();
    if (!this.stale || !this.differential.gears) return;
    this.stale = false;
    this.lamp.position.copy(this.camera.position);
    this.differential.housing.face(this.camera.position);
    this.renderer.render(this.scene, this.camera);
    this.label();
  }

  // Puts names next to the parts in the window.
  label() {
    const { reach, end, group, planets, drive, halfShafts } = this.differential;
    const turned = (position) => position.clone().applyEuler(group.rotation);
    const places = this.preset !== "whole" ? {} : {
      ...(drive && { ring: turned(drive.labels.ring), pinion: turned(drive.labels.pinion) }),
      left: new Vector3(end + 0.35 * reach, -0.62 * reach, 0),
      right: new Vector3(-end - 0.35 * reach, -0.62 * reach, 0),
      // the ring gear covers the clutches on its side
      ...Object.assign({}, ...halfShafts.filter(({ side }) => side !== drive?.place.side).map(({ labels }) => labels)),
      planet: new Vector3().setFromMatrixPosition(planets[0].matrixWorld)
        .add(new Vector3(0, 1.48 * reach, 0).applyEuler(this.differential.housing.carrier.rotation).applyEuler(group.rotation)),
    };
    const { clientWidth, clientHeight } = this.canvas.parentElement;
    for (const [name, element] of Object.entries(this.labels)) {
      const place = places[name]?.project(this.camera);
      element.hidden = !place || Math.abs(place.x) > 1.2 || Math.abs(place.y) > 0.95;
      if (!element.hidden) {
        const beside = clamp((place.x + 1) / 2 * clientWidth, MARGIN, clientWidth - MARGIN);
        const [x, y] = [beside, (1 - place.y) / 2 * clientHeight];
        element.style.transform = `translate(${x}px, ${y}px) translate(-50%, -50%)`;
      }
    }
  }
}

// True without a graphics unit: browsers then draw with a software renderer, which has one of these names.
function isDrawnByProcessor() {
  const context = document.createElement("canvas").getContext("webgl2");
  const extension = context?.getExtension("WEBGL_debug_renderer_info");
  const name = context?.getParameter(extension ? extension.UNMASKED_RENDERER_WEBGL : context.RENDERER);
  context?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|basic render|software/i.test(name ?? "");
}
