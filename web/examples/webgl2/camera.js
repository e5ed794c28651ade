/** A camera that sees all of these positions, as a function of the picture's proportions that gives its matrix. */
export function cameraAround(positions) {
  const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  positions.forEach((value, i) => {
    low[i % 3] = Math.min(low[i % 3], value);
    high[i % 3] = Math.max(high[i % 3], value);
  });
  const centre = low.map((value, axis) => (value + high[axis]) / 2);
  const radius = Math.max(1e-6, Math.hypot(...low.map((value, axis) => (high[axis] - value) / 2)));
  // Unit vectors to the right, up and towards the eye.
  const back = normalized([0.5, 0.35, 1]);
  const right = normalized([back[2], 0, -back[0]]);
  const up = [0, 1, 2].map((i) => back[(i + 1) % 3] * right[(i + 2) % 3] - back[(i + 2) % 3] * right[(i + 1) % 3]);
  const distance = 3.1 * radius;
  const [near, far] = [distance - 3 * radius, distance + 3 * radius];
  const zoom = 1 / Math.tan(0.35);
  return (aspect) => {
    const shift = (axis) => -axis.reduce((sum, value, i) => sum + value * centre[i], 0);
    const [x, y, z] = [shift(right), shift(up), shift(back) - distance];
    const scale = (near + far) / (near - far);
    const columns = [0, 1, 2].map((i) => [(right[i] * zoom) / aspect, up[i] * zoom, back[i] * scale, -back[i]]);
    return [...columns.flat(), (x * zoom) / aspect, y * zoom, z * scale + (2 * near * far) / (near - far), -z];
  };
}

function normalized(vector) {
  const length = Math.hypot(...vector);
  return vector.map((value) => value / length);
}
