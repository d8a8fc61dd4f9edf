// What is packed into the page: gzip in base64.

async function unpacked(id) {
  const text = document.getElementById(id).textContent.trim();
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip")));
}

export const embeddedBytes = async (id) => new Uint8Array(await (await unpacked(id)).arrayBuffer());
export const embeddedJson = async (id) => (await unpacked(id)).json();
