// What is looked at, in the part of the page's address after "#": scenario, methods, instant.

/** {t, a, b, scenario} of the address: texts, or undefined where the address says nothing. */
export function readAddress() {
  return Object.fromEntries(new URLSearchParams(location.hash.slice(1)));
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
