// Packed contents of the page, in base64: data in gzip, and the library in xz, which needs half as much space.

function packed(id) {
  const text = document.getElementById(id).textContent.trim();
  return Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
}

export function embeddedJson(id) {
  return new Response(new Blob([packed(id)]).stream().pipeThrough(new DecompressionStream("gzip"))).json();
}

// Still packed: the worker unpacks it while the page is built.
export const embeddedLibrary = packed;
