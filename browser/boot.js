// SPDX-License-Identifier: GPL-3.0-or-later
// Unpacks the parts of the page, which are compressed by gzip and written in 85 characters, four bytes as five of them.

(async () => {
  const digits = '0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ.-:+=^!/*?&_>()[]{}@%$#';
  const unpack = id => {
    const text = document.getElementById(id).textContent.trim(), length = Number(document.getElementById(id).dataset.length);
    const words = new DataView(new ArrayBuffer(4 * Math.ceil(length / 4)));
    for (let i = 0, k = 0; i < text.length; k += 4) {
      let word = 0;
      for (let j = 0; j < 5; ++j) word = 85 * word + digits.indexOf(text[i++]);
      words.setUint32(k, word);
    }
    const stream = new Blob([new Uint8Array(words.buffer, 0, length)]).stream();
    return new Response(stream.pipeThrough(new DecompressionStream('gzip')));
  };
  try {
    const [wasm, worker, script] = await Promise.all([unpack('wasm').arrayBuffer(), unpack('worker').text(),
                                                      unpack('script').text()]);
    new Function('wasmBytes', 'workerText', script)(wasm, worker);
  } catch (error) {
    document.getElementById('message').textContent = 'This page needs a browser of 2023 or later.\n' + error.message;
  }
})();
