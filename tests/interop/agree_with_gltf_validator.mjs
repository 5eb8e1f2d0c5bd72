#!/usr/bin/env node
// Do `zerotree validate` and glTF-Validator find the same errors?
// Usage: node agree_with_gltf_validator.mjs ZEROTREE SAMPLE.glb FOLDER VALIDATION.md
// FOLDER takes the broken files made out of SAMPLE.glb, a small right file with normals. Of codes
// that both tools know (VALIDATION.md and the npm package's ISSUES.md list them), each error and
// warning of one must be one of the other, with the same JSON pointer, and each code must come up.
// Exit code 0 if that holds.
import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { brokenFiles, mutatedFiles } from './broken_files.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const PACKAGE = join(here, 'node_modules', 'gltf-validator');

function sharedCodes(validationDocument) {
  const ours = [...readFileSync(validationDocument, 'utf8').matchAll(/^\| `([A-Z0-9_]+)` \|/gm)]
      .map((match) => match[1]);
  const theirs = new Set([...readFileSync(join(PACKAGE, 'ISSUES.md'), 'utf8')
      .matchAll(/^\|([A-Z0-9_]+)\|/gm)].map((match) => match[1]));
  return new Set(ours.filter((code) => theirs.has(code)));
}

// glTF-Validator does not look into the object of an extension that it does not know.
const INSIDE = /\/extensions\/ZEROTREE_mesh_progressive\//;
// It stops where a GLB ends early; zerotree reads on.
const STOPS = ['GLB_UNEXPECTED_END_OF_CHUNK_DATA ', 'GLB_UNEXPECTED_END_OF_CHUNK_HEADER '];

// Errors and warnings of shared codes as "CODE pointer", each once.
function errorsOf(report, shared) {
  const messages = report.issues.messages.filter(
      (m) => m.severity <= 1 && shared.has(m.code) && !INSIDE.test(m.pointer ?? ''));
  return new Set(messages.map(
      (m) => `${m.code} ${m.pointer ?? ''}${m.severity === 1 ? ' (warning)' : ''}`));
}

// null where glTF-Validator itself fails: it does for meshes that are no objects.
async function gltfValidatorErrors(validator, file, folder, shared) {
  const options = {
    uri: file.name,
    format: 'glb',
    maxIssues: 0,
    externalResourceFunction: async (uri) => new Uint8Array(readFileSync(join(folder, uri))),
  };
  try {
    return errorsOf(await validator.validateBytes(new Uint8Array(file.bytes), options), shared);
  } catch (error) {
    if (String(error).includes('NoSuchMethodError')) return null;
    throw error;
  }
}

function zerotreeErrors(zerotree, files, folder, shared) {
  const paths = files.map((file, i) => join(folder, `${i}.glb`));
  files.forEach((file, i) => writeFileSync(paths[i], file.bytes));
  const reportPath = join(folder, 'report.json');
  rmSync(reportPath, { force: true });
  const run = spawnSync(zerotree, ['validate', ...paths, '-o', reportPath],
                        { encoding: 'utf8', maxBuffer: 1 << 28 });
  if (run.status !== 1)
    throw new Error(`zerotree validate ended with ${run.status}: ${run.stderr}`);
  const reports = [JSON.parse(readFileSync(reportPath, 'utf8'))].flat();
  if (reports.length !== files.length)
    throw new Error(`${reports.length} reports of ${files.length} files`);
  return reports.map((report) => errorsOf(report, shared));
}

// What comes of the numbers of a bufferView when these are wrong: glTF-Validator goes on with
// others, zerotree does not look at the data.
function isConsequence(error, file, common) {
  return /^\/bufferViews\/\d/.test(file.pointer ?? '') && error.startsWith('ACCESSOR_') &&
      common.some((e) => e.includes(' /bufferViews/'));
}

function difference(a, b) {
  return [...a].filter((error) => !b.has(error));
}

async function main() {
  const [zerotree, sample, folder, validationDocument] = process.argv.slice(2);
  if (!validationDocument)
    throw new Error('usage: agree_with_gltf_validator.mjs ZEROTREE SAMPLE.glb FOLDER ' +
                    'VALIDATION.md');
  if (!existsSync(PACKAGE))
    throw new Error(`the npm packages are missing: run "npm ci" in ${here}`);
  const validator = (await import('gltf-validator')).default;
  const shared = sharedCodes(validationDocument);
  const base = readFileSync(sample);
  const files = [...brokenFiles(base), ...mutatedFiles(base)];
  mkdirSync(folder, { recursive: true });
  const theirs = [];
  for (const file of files)
    theirs.push(await gltfValidatorErrors(validator, file, folder, shared));
  const ours = zerotreeErrors(zerotree, files, folder, shared);
  let failures = 0, skipped = 0;
  const seen = new Set();
  files.forEach((file, i) => {
    if (theirs[i] === null) {
      skipped += 1;
      return;
    }
    const common = [...theirs[i]].filter((error) => ours[i].has(error));
    const missing = difference(theirs[i], ours[i])
        .filter((error) => !isConsequence(error, file, common));
    const stops = STOPS.some((error) => theirs[i].has(error));
    const added = stops ? [] : difference(ours[i], theirs[i]);
    const lacks = file.expected && !(ours[i].has(file.expected) && theirs[i].has(file.expected));
    for (const error of common) seen.add(error.split(' ')[0]);
    if (missing.length + added.length === 0 && !lacks) return;
    failures += 1;
    console.error(`FAILED ${i}.glb, ${file.name}:`);
    if (lacks) console.error(`  expected of both: ${file.expected}`);
    for (const error of missing) console.error(`  only glTF-Validator: ${error}`);
    for (const error of added) console.error(`  only zerotree: ${error}`);
  });
  const unseen = [...shared].filter((code) => !seen.has(code));
  if (unseen.length > 0) console.error(`FAILED: no file has ${unseen.join(', ')}`);
  console.log(`${files.length} files, ${skipped} of which glTF-Validator fails on; ` +
              `${shared.size} codes that both know`);
  return failures + unseen.length === 0 ? 0 : 1;
}

main().then((code) => process.exit(code), (error) => {
  console.error(`agree_with_gltf_validator: ${error.message ?? error}`);
  process.exit(1);
});
