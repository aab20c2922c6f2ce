// A page opened from a file may start no worker; the search then runs in a hidden frame, which may read its script.
if (location.protocol === "file:") {
  window.Worker = class extends EventTarget {
    constructor(url) {
      super();
      const frame = document.createElement("iframe");
      frame.hidden = true;
      document.body.appendChild(frame);
      this.inner = frame.contentWindow;
      window.addEventListener("message", (event) => {
        if (event.source !== this.inner) return;
        const message = new MessageEvent("message", { data: event.data });
        this.dispatchEvent(message);
        if (this.onmessage) this.onmessage(message);
      });
      this.ready = new Promise((resolve) => frame.addEventListener("load", resolve, { once: true }));
      this.inner.document.open();
      this.inner.document.write(
        "<script>postMessage = (message) => parent.postMessage(message, '*');" +
          "importScripts = (...urls) => urls.reduce((done, url) => done.then(() => new Promise((resolve) => {" +
          "const script = document.createElement('script'); script.src = url; script.onload = resolve;" +
          "document.body.appendChild(script); })), Promise.resolve());</" +
          `script><body><script src="${url}"></` +
          "script></body>",
      );
      this.inner.document.close();
    }
    postMessage(message) {
      this.ready.then(() => this.inner.dispatchEvent(new MessageEvent("message", { data: message })));
    }
    terminate() {}
  };
}
