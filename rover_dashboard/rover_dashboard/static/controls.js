// Buttons and parameters: what a person asks of the rover, and what became of it.

export class Controls {
  constructor(connection) {
    this.connection = connection;
    this.answer = document.getElementById("answer");
    this.settings = document.getElementById("settings");
    this.inputs = new Map();
    document.getElementById("controls").addEventListener("submit", (event) => event.preventDefault());
    for (const button of document.querySelectorAll("[data-request]")) {
      button.addEventListener("click", () => this.ask({ request: button.dataset.request }));
    }
  }

  async ask(body) {
    this.tell("…", true);
    const { ok, text } = await this.connection.ask(body);
    this.tell(text, ok);
  }

  tell(text, ok) {
    this.answer.textContent = text;
    this.answer.classList.toggle("refused", !ok);
  }

  // One control for each settable parameter: {name: {description, minimum, maximum, choices}}.
  offer(settings) {
    this.settings.replaceChildren();
    this.inputs.clear();
    for (const [name, info] of Object.entries(settings)) {
      const label = document.createElement("label");
      label.title = info.description;
      label.append(words(name));
      const input = info.choices.length ? choice(info.choices) : number(info);
      input.disabled = true; // until its value is known
      input.dataset.parameter = name;
      input.addEventListener("change", () => this.set(name, input));
      label.append(input);
      this.settings.append(label);
      this.inputs.set(name, input);
    }
  }

  set(name, input) {
    const value = input.type === "number" ? input.valueAsNumber : input.value;
    if (!input.reportValidity()) return;
    this.ask({ set: name, value });
  }

  // The decision node's values; null when it does not answer.
  showValues(values) {
    for (const [name, input] of this.inputs) {
      input.disabled = values === null;
      if (values !== null && document.activeElement !== input) input.value = values[name];
    }
  }
}

function choice(choices) {
  const select = document.createElement("select");
  for (const value of choices) select.add(new Option(words(value), value));
  return select;
}

function number(info) {
  const input = document.createElement("input");
  Object.assign(input, {
    type: "number", min: info.minimum, max: info.maximum, step: 0.1, required: true,
  });
  return input;
}

function words(name) {
  return name.replaceAll("_", " ");
}
