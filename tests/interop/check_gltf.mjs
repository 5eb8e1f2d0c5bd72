#!/usr/bin/env node
// Do the tools others use accept a progressive glTF file and show its base mesh?
// Usage: node check_gltf.mjs FILE.glb|FILE.gltf|FOLDER...
// Per file: gltf-validator finds no error and no warning, three's GLTFLoader and assimp load a mesh
// with as many vertices and triangles as the accessors state. assimp is not asked about files that
// require extensions. Exit code 0 if all hold.
import { execFileSync } from 'node:child_process';
import { existsSync, readdirSync, readFileSync, statSync } from 'node:fs';
import { dirname, extname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const EXTENSION = 'ZEROTREE_mesh_progressive';

function fail(message) {
  throw new Error(message);
}

async function loadPackages() {
  if (!existsSync(join(here, 'node_modules', 'three')) ||
      !existsSync(join(here, 'node_modules', 'gltf-validator'))) {
    fail(`the npm packages are missing: run "npm ci" in ${here}`);
  }
  const validator = (await import('gltf-validator')).default;
  const { GLTFLoader } = await import('three/examples/jsm/loaders/GLTFLoader.js');
  const { MeshoptDecoder } = await import('three/examples/jsm/libs/meshopt_decoder.module.js');
  return { validator, makeLoader: () => new GLTFLoader().setMeshoptDecoder(MeshoptDecoder) };
}

function resourceBytes(file, uri) {
  return new Uint8Array(readFileSync(join(dirname(file), decodeURIComponent(uri))));
}

function readJson(file) {
  const bytes = readFileSync(file);
  if (bytes.toString('latin1', 0, 4) !== 'glTF') return JSON.parse(bytes.toString('utf8'));
  return JSON.parse(bytes.toString('utf8', 20, 20 + bytes.readUInt32LE(12)));
}

// What every reader should see, from the accessors alone.
function expectedCounts(json) {
  let vertices = 0, triangles = 0, hasNormals = true;
  for (const mesh of json.meshes) {
    hasNormals &&= mesh.primitives.every((p) => 'NORMAL' in p.attributes);
    const positions = new Set(mesh.primitives.map((p) => p.attributes.POSITION));
    for (const index of positions) vertices += json.accessors[index].count;
    for (const p of mesh.primitives) triangles += json.accessors[p.indices].count / 3;
  }
  return { vertices, triangles, hasNormals };
}

async function checkValidator(validator, file) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), {
    uri: file,
    externalResourceFunction: async (uri) => resourceBytes(file, uri),
  });
  const { numErrors, numWarnings, messages } = report.issues;
  const serious = messages.filter((m) => m.severity <= 1);
  if (numErrors + numWarnings > 0)
    fail('gltf-validator: ' + serious.map((m) => `${m.code} ${m.pointer}: ${m.message}`).join('; '));
  return messages.map((m) => m.code);
}

// GLTFLoader fetches external buffers by URL; node has no such server, so they become data URIs.
// A GLB with external buffers keeps its first buffer in the binary chunk: rewritten as .gltf.
function selfContained(file, json) {
  const bytes = readFileSync(file);
  const isGlb = bytes.toString('latin1', 0, 4) === 'glTF';
  if (isGlb && !json.buffers.some((b) => b.uri))
    return bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
  const copy = structuredClone(json);
  const binaryStart = isGlb ? 20 + bytes.readUInt32LE(12) + 8 : 0;
  for (const buffer of copy.buffers) {
    if (buffer.extensions?.EXT_meshopt_compression?.fallback) continue;  // has no data
    const data = buffer.uri ? Buffer.from(resourceBytes(file, buffer.uri))
                            : bytes.subarray(binaryStart, binaryStart + buffer.byteLength);
    buffer.uri = 'data:application/octet-stream;base64,' + data.toString('base64');
  }
  return JSON.stringify(copy);
}

async function checkThree(makeLoader, file, json, expected) {
  // The loader asks for the browser's name and for URLs of images; node has neither.
  globalThis.self ??= globalThis;
  globalThis.ProgressEvent ??= class ProgressEvent extends Event {};
  const gltf = await makeLoader().parseAsync(selfContained(file, json), '');
  let vertices = 0, triangles = 0, extensions = 0;
  gltf.scene.traverse((object) => {
    if (!object.isMesh) return;
    const { attributes, index } = object.geometry;
    vertices += attributes.position.count;
    triangles += index.count / 3;
    if ('normal' in attributes !== expected.hasNormals)
      fail(`three: the base mesh has ${attributes.normal ? '' : 'no '}normals`);
    object.geometry.computeBoundingBox();
    if (object.geometry.boundingBox.isEmpty()) fail('three: the positions are no numbers');
  });
  for (const mesh of gltf.parser.json.meshes) extensions += mesh.extensions?.[EXTENSION] ? 1 : 0;
  if (vertices !== expected.vertices || triangles !== expected.triangles)
    fail(`three: ${vertices} vertices and ${triangles} triangles instead of ` +
         `${expected.vertices} and ${expected.triangles}`);
  if (extensions === 0) fail(`three: an aware loader would not see ${EXTENSION}`);
}

function checkAssimp(file, expected) {
  let text;
  try {
    // --raw: without it assimp joins vertices and drops degenerate faces before it counts.
    text = execFileSync('assimp', ['info', file, '--raw'], { encoding: 'utf8', stdio: 'pipe' });
  } catch (error) {
    fail(error.code === 'ENOENT' ? 'assimp is missing: install the Debian package assimp-utils'
                                 : `assimp: ${error.stdout}${error.stderr}`);
  }
  const count = (label) => Number(new RegExp(`^${label}:\\s+(\\d+)`, 'm').exec(text)?.[1]);
  if (count('Vertices') !== expected.vertices || count('Faces') !== expected.triangles)
    fail(`assimp: ${count('Vertices')} vertices and ${count('Faces')} faces instead of ` +
         `${expected.vertices} and ${expected.triangles}`);
}

async function check(packages, file) {
  const json = readJson(file);
  const expected = expectedCounts(json);
  const codes = await checkValidator(packages.validator, file);
  await checkThree(packages.makeLoader, file, json, expected);
  if (!json.extensionsRequired) checkAssimp(file, expected);
  console.log(`ok ${file}: ${expected.vertices} vertices, ${expected.triangles} triangles; ` +
              `gltf-validator's infos: ${codes.join(', ') || 'none'}`);
}

function filesOf(argument) {
  if (!statSync(argument).isDirectory()) return [argument];
  return readdirSync(argument).filter((name) => ['.glb', '.gltf'].includes(extname(name)))
      .sort().map((name) => join(argument, name));
}

async function main() {
  const files = process.argv.slice(2).flatMap(filesOf);
  if (files.length === 0) fail('no files: name .glb or .gltf files or a folder of them');
  const packages = await loadPackages();
  let failures = 0;
  for (const file of files) {
    try {
      await check(packages, file);
    } catch (error) {
      failures += 1;
      console.error(`FAILED ${file}: ${error.message}`);
    }
  }
  return failures === 0 ? 0 : 1;
}

main().then((code) => process.exit(code), (error) => {
  console.error(`check_gltf: ${error.message}`);
  process.exit(1);
});
