// What is looked at, in the part of the page's address after "#": scenario, methods, instant.

/** The keys of an address, {t, a, b, camera, scenario}: texts, or undefined where it says nothing. */
export function parsedAddress(text) {
  return Object.fromEntries(new URLSearchParams(text));
}

export const readAddress = () => parsedAddress(location.hash.slice(1));

/** A sentence on the first thing in an address that the page does not have; else undefined. */
export function unknownIn(asked, walks, camera) {
  const methods = walks.map((walk) => walk.label);
  const valid = {
    a: methods, b: [...methods, "none"], camera: [...camera.options].map((option) => option.value),
  };
  for (const [key, value] of Object.entries(asked)) {
    if (key === "t" && !Number.isFinite(Number.parseFloat(value))) return `t: ${value} (valid: seconds)`;
    if (valid[key] && !valid[key].includes(value)) return `${key}: ${value} (valid: ${valid[key].join(", ")})`;
    if (!["t", "a", "b", "camera", "scenario"].includes(key)) return `${key} (valid: t, a, b, camera)`;
  }
  return undefined;
}

/** Puts it into the address and on the clipboard. Resolves to what to tell. */
export async function copyAddress(shown) {
  location.hash = new URLSearchParams(shown).toString();
  try {
    await navigator.clipboard.writeText(location.href);
    return "Link copied.";
  } catch {
    return "The link is in the address bar.";
  }
}
