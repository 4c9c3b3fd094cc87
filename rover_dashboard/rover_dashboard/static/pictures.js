// Camera and vision image, each with its age; an old one fades.

const STALE = 2; // [s]

export class Pictures {
  constructor() {
    this.pictures = new Map();
    this.recorded = false; // images of a recording do not grow old
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
      const stale = heard === null || (age > STALE && !this.recorded);
      figure.classList.toggle("stale", stale);
      if (heard === null) caption.textContent = "no image";
      else if (stale) caption.textContent = `${age.toFixed(0)} s old`;
      else caption.textContent = this.recorded ? "recorded" : "live";
    }
  }
}
