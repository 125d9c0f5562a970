// Texts as `packing.py` packs them.
const DIGIT = [];
[..."0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#$%,()*+-;.=:?@^_`{|}~"].forEach((letter, n) => {
  DIGIT[letter.charCodeAt(0)] = n;
});

// A script element holds a text by `packed` of packing.py.
async function unpacked(script) {
  const text = script.textContent, bytes = new DataView(new ArrayBuffer((text.length - 1) / 5 * 4));
  for (let k = 1; k < text.length; k += 5) {
    let word = 0;
    for (let j = k; j < k + 5; j += 1) word = word * 85 + DIGIT[text.charCodeAt(j)];
    bytes.setUint32((k - 1) / 5 * 4, word);
  }
  const stream = new Blob([bytes.buffer.slice(0, bytes.byteLength - Number(text[0]))]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).text();
}
