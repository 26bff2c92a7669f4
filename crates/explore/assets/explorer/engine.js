'use strict';
const byId = id => document.getElementById(id);
// Engines in workers.

/** The compiled engine. */
async function compile() {
  const bytes = Uint8Array.from(atob(byId('engine').textContent.trim()), letter => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return WebAssembly.compile(await new Response(stream).arrayBuffer());
}

/** An engine in a worker of its own. Of the questions about one subject only the latest waits. */
class Engine {
  constructor(module) {
    this.module = module;
    this.script = URL.createObjectURL(new Blob([byId('worker').textContent], { type: 'text/javascript' }));
    this.waiting = new Map();
    this.now = null;
    this.start();
  }
  start() {
    this.worker = new Worker(this.script);
    this.worker.postMessage(this.module);
    this.worker.onmessage = ({ data }) => this.finish(data);
    this.worker.onerror = event => {
      event.preventDefault();
      this.worker.terminate();
      this.start();
      this.finish({ told: { error: 'the engine stopped at this machine' }, numbers: new Float64Array(), took: 0 });
    };
  }
  /** Asks a question, which is made when its turn comes. */
  ask(subject, question, then) {
    this.waiting.set(subject, { question, then });
    this.next();
  }
  next() {
    if (this.now) return;
    const [first] = this.waiting;
    if (!first) return;
    this.waiting.delete(first[0]);
    this.now = first[1];
    this.worker.postMessage(JSON.stringify(this.now.question()));
  }
  finish(answer) {
    const { then } = this.now;
    this.now = null;
    then(answer);
    this.next();
  }
}
