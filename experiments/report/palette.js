// Colours of Okabe and Ito, told apart with any colour vision.
export const left = "#0072B2";
export const right = "#E69F00";
export const com = "#009E73";
export const zmp = "#D55E00";
export const limit = "#D55E00";
export const second = "#CC79A7"; // walk B
export const sky = "#56B4E9";
export const yellow = "#F0E442";
export const olive = "#8a7d00";
export const grey = "#8a94a0";

// Muted, for the robot: what is rigid with the waist, and the links of its legs.
export const trunk = "#e1e5ea";
export const head = "#d3d9e0";
export const visor = "#2a323b";
export const joint = "#7b8692"; // necks, forearms
export const arm = "#c3cbd4";
export const legs = ["#a9cbe2", "#f0d9ac"];
export const feet = [left, right];

/** For things that have no order, one after the other. */
export const sequence = [left, zmp, com, second, right, sky, "#000000"];

/** Of families of margins, in their order. */
export const margins = () => [right, zmp, com, sky, second, theme.ink, left, grey, olive, limit];

/** The colour with an opacity from 0 to 1. */
export function faded(colour, opacity) {
  return colour + Math.round(255 * opacity).toString(16).padStart(2, "0");
}

const light = {
  ink: "#1d2733", sky: "#f3f5f8", grid: "#5f7084", page: "#ffffff", lines: "#e6eaef",
  ticks: "#c9d1da", numbers: "#4a5563", support: "#e3eef6",
  leftInk: "#00558a", rightInk: "#8a5a00",
};
const dark = {
  ink: "#e6ebf1", sky: "#1b222b", grid: "#8fa0b3", page: "#12171d", lines: "#2a333d",
  ticks: "#465361", numbers: "#b4bfcb", support: "#22384a",
  leftInk: "#6cbcec", rightInk: "#f0b84d",
};

/** Colours of what is neither a walk nor a quantity; useTheme chooses them. */
export const theme = { ...light };

export function useTheme(isDark) {
  Object.assign(theme, isDark ? dark : light);
}
