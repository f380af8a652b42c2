// Copyright and permission notices of the npm packages in a bundle: their licences ask that every
// copy carries them.
import { existsSync } from "node:fs";
import { readdir, readFile } from "node:fs/promises";
import path from "node:path";

const MODULES = "node_modules/";

/** The folder of the package that an input of a bundle belongs to, or null for a file of ours. */
function packageFolder(input) {
  const at = input.lastIndexOf(MODULES);
  if (at < 0) return null;
  const parts = input.slice(at + MODULES.length).split("/");
  return input.slice(0, at) + MODULES + parts.slice(0, parts[0].startsWith("@") ? 2 : 1).join("/");
}

// The licence file; of a package that came without one, what it declares of itself.
async function licenceText(folder, { license, author }) {
  const names = (await readdir(folder)).filter((name) => /^licen[cs]e/i.test(name)).sort();
  if (names.length > 0) return (await readFile(path.join(folder, names[0]), "utf8")).trim();
  if (!license) throw new Error(`${folder} is bundled, but names no licence to pass on`);
  return `${license} licence, by ${author?.name ?? author ?? "its authors"}`;
}

/**
 * The notices of every package that esbuild's metafiles name, equal texts once. Throws where a
 * package has none: such a package may not be bundled.
 */
export async function notices(metafiles) {
  const inputs = metafiles.flatMap((metafile) => Object.keys(metafile.inputs));
  const folders = [...new Set(inputs.map(packageFolder))].filter((folder) => folder && existsSync(folder));
  const packagesOf = new Map();
  for (const folder of folders.sort()) {
    const about = JSON.parse(await readFile(path.join(folder, "package.json"), "utf8"));
    const text = await licenceText(folder, about);
    packagesOf.set(text, [...(packagesOf.get(text) ?? []), `${about.name} ${about.version}`]);
  }
  return [...packagesOf].map(([text, packages]) => `${packages.join(", ")}\n\n${text}`).join("\n\n----\n\n");
}
