// Messages of protocol 3 over a WebSocket, from the server that served this page.

const statePeriod = 0.03; // at least; the control period when that is longer [s]
const motionSpan = 3; // of the walk to come [s]
const comeBackAfter = 1000; // [ms]

export class SocketSource {
  /** Calls onMessage(object) for each message, onState(text, isOpen) when the connection changes. */
  constructor(onMessage, onState) {
    this.onMessage = onMessage;
    this.onState = onState;
    this.ended = false;
    this.again = false;
    this.open();
  }

  open() {
    const address = new URL("socket", location.href);
    address.protocol = "ws:";
    this.onState("connecting", false);
    this.socket = new WebSocket(address);
    this.socket.addEventListener("message", ({ data }) => this.take(JSON.parse(data)));
    this.socket.addEventListener("close", () => {
      if (this.again) return this.comeBack(address);
      this.onState(this.ended ? "the episode has ended" : "not connected", false);
    });
  }

  take(message) {
    if (message.type === "hello") {
      this.onState("connected", true);
      this.send({ type: "draw" });
      this.send({ type: "subscribe", state_period_s: Math.max(statePeriod, message.control_period_s),
                  motion_s: motionSpan });
    }
    if (message.type === "end") [this.ended, this.again] = [true, message.again];
    this.onMessage(message);
  }

  // The episode begins anew at the same address: the page is loaded again as soon as it is there.
  comeBack(address) {
    this.onState("the episode begins anew", false);
    setTimeout(() => {
      const next = new WebSocket(address);
      next.addEventListener("open", () => location.reload());
      next.addEventListener("close", () => this.comeBack(address));
    }, comeBackAfter);
  }

  send(message) {
    const isOpen = this.socket.readyState === WebSocket.OPEN;
    if (isOpen) this.socket.send(JSON.stringify(message));
    return isOpen;
  }
}
