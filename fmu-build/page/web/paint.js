// Metal, and metal painted in a colour that represents a value. Painted parts emit a little light and mirror less, so
// that their colour matches the legend.
const MIRROR = { own: 0.72, painted: 0.15 };
const SHINE = 0.16;
const LIT = 0.7; // fraction of the colour: light makes it brighter than in the legend

export function paint(material, own, colour) {
  material.color.set(colour ?? own);
  if (colour) material.color.multiplyScalar(LIT);
  material.metalness = colour ? MIRROR.painted : MIRROR.own;
  if (colour) material.emissive.copy(colour).multiplyScalar(SHINE);
  else material.emissive.set(0);
}
