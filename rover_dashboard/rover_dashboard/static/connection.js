// The WebSocket to the node: opens again when it is lost, and decodes what comes.

const RETRY = 1500; // [ms]
const NEWLINE = 10;

export class Connection {
  // onMessage({slot, age, data | content, ...}); onLink("connecting" | "connected" | "lost")
  constructor(onMessage, onLink) {
    this.onMessage = onMessage;
    this.onLink = onLink;
    this.pending = new Map();
    this.lastId = 0;
    this.open();
  }

  open() {
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    this.socket = new WebSocket(`${scheme}://${location.host}/live`);
    this.socket.binaryType = "arraybuffer";
    this.socket.onopen = () => this.onLink("connected");
    this.socket.onmessage = (event) => this.receive(decode(event.data));
    this.socket.onclose = () => {
      for (const settle of this.pending.values()) settle({ ok: false, text: "the connection was lost" });
      this.pending.clear();
      this.onLink("lost");
      setTimeout(() => this.open(), RETRY);
    };
  }

  receive(message) {
    if (message.slot !== "answer") {
      this.onMessage(message);
      return;
    }
    this.pending.get(message.data.id)?.(message.data);
    this.pending.delete(message.data.id);
  }

  // Resolves to {ok, text}.
  ask(body) {
    if (this.socket.readyState !== WebSocket.OPEN) {
      return Promise.resolve({ ok: false, text: "not connected" });
    }
    this.lastId += 1;
    this.socket.send(JSON.stringify({ id: this.lastId, ...body }));
    return new Promise((resolve) => this.pending.set(this.lastId, resolve));
  }
}

// Text is JSON; binary is a line of JSON and the bytes that it describes.
function decode(data) {
  if (typeof data === "string") return JSON.parse(data);
  const bytes = new Uint8Array(data);
  const end = bytes.indexOf(NEWLINE);
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(0, end)));
  return { ...header, content: new Blob([bytes.subarray(end + 1)], { type: header.type }) };
}
