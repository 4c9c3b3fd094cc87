// Camera and vision image, each with its age; an old one fades.

const STALE = 2; // [s]

export class Pictures {
  constructor() {
    this.pictures = new Map();
    for (const figure of document.querySelectorAll("[data-picture]")) {
      const canvas = figure.querySelector("canvas");
      this.pictures.set(figure.dataset.picture, {
        figure, canvas, caption: figure.querySelector("figcaption"), heard: null,
      });
    }
    setInterval(() => this.tell(), 500);
  }

  async show(name, message) {
    const picture = this.pictures.get(name);
    picture.heard = message.content ? performance.now() - 1000 * message.age : null;
    if (!message.content) {
      this.tell();
      return;
    }
    const bitmap = await createImageBitmap(message.content);
    const { canvas } = picture;
    if (canvas.width !== bitmap.width || canvas.height !== bitmap.height) {
      canvas.width = bitmap.width;
      canvas.height = bitmap.height;
    }
    canvas.getContext("2d").drawImage(bitmap, 0, 0);
    bitmap.close();
    if (picture.figure.classList.contains("stale") || picture.first === undefined) this.tell();
    picture.first = false;
  }

  tell() {
    for (const { figure, caption, heard } of this.pictures.values()) {
      const age = heard === null ? Infinity : (performance.now() - heard) / 1000;
      figure.classList.toggle("stale", age > STALE);
      caption.textContent = heard === null ? "no image" : age > STALE ? `${age.toFixed(0)} s old` : "live";
    }
  }
}
