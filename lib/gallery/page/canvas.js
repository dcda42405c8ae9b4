// Canvases that zoom and move.

// `zoom` times the size at which all of it fits; x and y are what lies in the middle, as shares.
function movable(canvas, redraw) {
  const area = {canvas, zoom: 1, x: 0.5, y: 0.5, span: [1, 1]};
  area.reset = () => { area.zoom = 1; area.x = area.y = 0.5; };
  area.fit = () => {
    const ratio = window.devicePixelRatio || 1;
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
    const context = canvas.getContext('2d');
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.filter = 'none';
    context.clearRect(0, 0, width, height);
    return context;
  };
  canvas.addEventListener('wheel', event => {
    event.preventDefault();
    const box = canvas.getBoundingClientRect();
    const by = Math.exp(-event.deltaY * 0.0015);
    const zoom = Math.min(80, Math.max(1, area.zoom * by));
    const grown = 1 / area.zoom - 1 / zoom;
    area.x += ((event.clientX - box.left) / box.width - 0.5) * area.span[0] * grown;
    area.y += ((event.clientY - box.top) / box.height - 0.5) * area.span[1] * grown;
    area.zoom = zoom;
    if (zoom === 1) area.reset();
    redraw();
  }, {passive: false});
  canvas.addEventListener('pointerdown', event => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener('pointermove', event => {
    if (!event.buttons) return;
    const box = canvas.getBoundingClientRect();
    area.x -= event.movementX / box.width * area.span[0] / area.zoom;
    area.y -= event.movementY / box.height * area.span[1] / area.zoom;
    redraw();
  });
  canvas.addEventListener('dblclick', () => { area.reset(); redraw(); });
  return area;
}
