// What is packed into the page, in base64: data in gzip, the library in xz, which is half as large.

function packed(id) {
  const text = document.getElementById(id).textContent.trim();
  return Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
}

export function embeddedJson(id) {
  return new Response(new Blob([packed(id)]).stream().pipeThrough(new DecompressionStream("gzip"))).json();
}

// Still packed: the worker unpacks it while the page is made.
export const embeddedLibrary = packed;
