// Metal, and metal painted in a colour that means a value. What is painted shines a little by itself and mirrors less, so that its
// colour is that of the legend.
const MIRROR = { own: 0.72, painted: 0.15 };
const SHINE = 0.16;
const LIT = 0.7; // of the colour: light makes it brighter than it is in the legend

export function paint(material, own, colour) {
  material.color.set(colour ?? own);
  if (colour) material.color.multiplyScalar(LIT);
  material.metalness = colour ? MIRROR.painted : MIRROR.own;
  if (colour) material.emissive.copy(colour).multiplyScalar(SHINE);
  else material.emissive.set(0);
}
