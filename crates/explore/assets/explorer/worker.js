'use strict';
// In a worker: answers questions, texts of JSON, with the engine, which comes first.
let engine = null;
onmessage = ({ data }) => {
  if (data instanceof WebAssembly.Module) {
    engine = new WebAssembly.Instance(data).exports;
    return;
  }
  const begin = performance.now(), question = new TextEncoder().encode(data);
  const place = engine.question(question.length);
  new Uint8Array(engine.memory.buffer, place, question.length).set(question);
  engine.answer();
  const text = new Uint8Array(engine.memory.buffer, engine.text(), engine.text_length());
  const told = JSON.parse(new TextDecoder().decode(text));
  const numbers = new Float64Array(engine.memory.buffer, engine.numbers(), engine.numbers_length()).slice();
  postMessage({ told, numbers, took: performance.now() - begin }, [numbers.buffer]);
};
