// A robot's bodies, moved by the joint angles of a walk.
import * as THREE from "three";
import { toCreasedNormals } from "three/addons/utils/BufferGeometryUtils.js";
import { rodGeometry, shoeOf, visorOf } from "./looks.js";
import * as palette from "./palette.js";

/** Coordinates of the data are integers of 0.1 mm. */
export function meshGeometry({ vertices, triangles }) {
  const geometry = new THREE.BufferGeometry();
  const positions = Float32Array.from(vertices, (v) => v * 1e-4);
  geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
  geometry.setIndex(triangles);
  return toCreasedNormals(geometry, 0.65);
}

function colourOf(body) {
  if (body.leg >= 0) return body.link === 5 ? palette.feet[body.leg] : palette.legs[body.leg];
  if (/head|neck/i.test(body.name)) return palette.head;
  return /arm|hand|elbow|shoulder|wrist/i.test(body.name) ? palette.arm : palette.trunk;
}

// What is highest of the bodies over the waist, in the middle; null where nothing is.
function headOf(bodies) {
  let highest = null;
  for (const body of bodies.filter(({ leg }) => leg < 0)) {
    body.geometry.computeBoundingBox();
    const { min, max } = body.geometry.boundingBox;
    const central = Math.abs(min.y + max.y) < 0.5 * (max.y - min.y);
    if (central && max.z > (highest?.geometry.boundingBox.max.z ?? 0)) highest = body;
  }
  return highest;
}

// Upright, with straight legs [m].
function heightOf(json, bodies) {
  const tops = bodies.filter(({ leg }) => leg < 0).map(({ geometry }) => geometry.boundingBox.max.z);
  return Math.max(0, ...tops) - Math.min(...json.legs.map(({ sole }) => sole[11]));
}

// What is drawn about a robot's bodies, each {leg, link, geometry, colour}; a body of which another
// shape is drawn has `replaced`.
function looksOf(json, bodies) {
  const head = headOf(bodies);
  const looks = (json.rods ?? []).map((rod) => ({
    leg: rod.leg, link: rod.link, geometry: rodGeometry(rod),
    colour: rod.leg < 0 ? palette.joint : palette.legs[rod.leg],
  }));
  for (const body of bodies) {
    const { leg, link } = body;
    if (body === head) looks.push({ leg, link, geometry: visorOf(body), colour: palette.visor });
    if (link !== 5 || bodies.filter((one) => one.leg === leg && one.link === 5).length > 1) continue;
    const drawn = shoeOf(body, json.legs[leg], json.sole);
    if (!drawn) continue;
    body.replaced = true;
    looks.push({ leg, link, geometry: drawn.shoe, colour: palette.feet[leg] },
               { leg, link, geometry: drawn.tread, colour: palette.visor });
  }
  return looks;
}

function solidMaterial(colour) {
  return new THREE.MeshStandardMaterial({ color: colour, roughness: 0.62, metalness: 0.05 });
}

export function ghostMaterial(colour, opacity) {
  return new THREE.MeshStandardMaterial({
    color: colour, roughness: 0.8, transparent: true, opacity, depthWrite: false,
  });
}

/** The parts that every figure of one robot shares. */
export class RobotShapes {
  constructor(json) {
    this.json = json;
    this.bodies = json.bodies.map((body) => {
      const geometry = meshGeometry(body);
      return { ...body, geometry, edges: new THREE.EdgesGeometry(geometry, 32) };
    });
    this.looks = looksOf(json, this.bodies);
    /** Its height over that of HRP-2: cameras stand nearer to a smaller robot. */
    this.scale = heightOf(json, this.bodies) / 1.56;
    this.joints = json.legs.map(({ joints: leg }) =>
      leg.map((joint) => ({
        ...joint,
        axis: new THREE.Vector3(...joint.axis).normalize(),
        point: new THREE.Vector3(...joint.point),
        column: `q_${joint.name}_rad`,
      })),
    );
  }
}

const edgeMaterial = new THREE.LineBasicMaterial({
  color: "#2b3540", transparent: true, opacity: 0.38,
});
const rotated = new THREE.Vector3();

/** One robot: `group` is posed by pose(). */
export class RobotFigure {
  /** Without `material` in the robot's own colours. */
  constructor(shapes, material = null) {
    this.shapes = shapes;
    this.group = new THREE.Group(); // the waist
    this.links = shapes.joints.map((leg) => {
      let parent = this.group;
      return leg.map(() => {
        const link = new THREE.Group();
        link.matrixAutoUpdate = false;
        parent.add(link);
        return (parent = link);
      });
    });
    const add = ({ leg, link, geometry }, colour) => {
      const mesh = new THREE.Mesh(geometry, material ?? solidMaterial(colour));
      mesh.castShadow = mesh.receiveShadow = material === null;
      (leg < 0 ? this.group : this.links[leg][link]).add(mesh);
      return mesh;
    };
    this.replaced = []; // bodies, and the looks in their place
    this.looks = shapes.looks.map((look) => add(look, look.colour));
    for (const body of shapes.bodies) {
      const mesh = add(body, colourOf(body));
      if (material === null) mesh.add(new THREE.LineSegments(body.edges, edgeMaterial));
      if (body.replaced) this.replaced.push(mesh);
    }
    this.showBodies(false);
  }

  /** Whether the bodies that proofs use are drawn alone, or what looks like a robot. */
  showBodies(alone) {
    for (const mesh of this.replaced) mesh.visible = alone;
    for (const mesh of this.looks) mesh.visible = !alone;
  }

  /** As `walk` has it at a place of locate(). A leg that does not reach is not shown. */
  pose(walk, at) {
    const of = (name) => walk.value(name, at);
    this.group.position.set(of("waist_x_m"), of("waist_y_m"), of("waist_z_m"));
    this.group.rotation.z = of("waist_yaw_rad");
    this.shapes.joints.forEach((leg, side) => {
      const reaches = leg.every((joint) => Number.isFinite(of(joint.column)));
      this.links[side][0].visible = reaches;
      if (!reaches) return;
      leg.forEach((joint, i) => {
        const link = this.links[side][i];
        link.matrix.makeRotationAxis(joint.axis, of(joint.column));
        rotated.copy(joint.point).applyMatrix4(link.matrix);
        link.matrix.setPosition(joint.point.clone().sub(rotated));
        link.matrixWorldNeedsUpdate = true;
      });
    });
  }
}
