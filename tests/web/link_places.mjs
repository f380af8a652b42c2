// Where the links of a rover are, from the data of a page alone.

const times = ([aw, ax, ay, az], [bw, bx, by, bz]) => [
  aw * bw - ax * bx - ay * by - az * bz,
  aw * bx + ax * bw + ay * bz - az * by,
  aw * by - ax * bz + ay * bw + az * bx,
  aw * bz + ax * by - ay * bx + az * bw,
];

const unit = (q) => q.map((value) => value / Math.hypot(...q));

export const rotated = (q, v) => times(times(q, [0, ...v]), [q[0], -q[1], -q[2], -q[3]]).slice(1);

/** Pivots and attitudes of all links at sample i, from the definition in payload.ts. */
export function expectedLinks({ links }, motion, i) {
  const placed = [];
  for (const { name, parent, pivot, axis } of links) {
    if (placed.length === 0) {
      placed.push({ at: [motion.x[i], motion.y[i], motion.z[i]], turn: unit([motion.qw[i], motion.qx[i], motion.qy[i], motion.qz[i]]) });
      continue;
    }
    const { at, turn } = placed[parent];
    const angle = motion.joints[name][i];
    const offset = rotated(turn, pivot);
    const own = [Math.cos(angle / 2), ...axis.map((a) => a * Math.sin(angle / 2))];
    placed.push({ at: at.map((value, k) => value + offset[k]), turn: times(turn, own) });
  }
  return placed;
}
