// Broken glTF files that both validators look into, made out of one that is right.

/// { json, binary } of a GLB.
export function splitGlb(bytes) {
  const jsonLength = bytes.readUInt32LE(12);
  return { json: JSON.parse(bytes.toString('utf8', 20, 20 + jsonLength)),
           binary: Buffer.from(bytes.subarray(28 + jsonLength)) };
}

function chunk(type, data) {
  const header = Buffer.alloc(8);
  header.writeUInt32LE(data.length, 0);
  header.write(type, 4, 'latin1');
  return Buffer.concat([header, data]);
}

function container(chunks) {
  const header = Buffer.from('glTF\x02\0\0\0\0\0\0\0', 'latin1');
  const bytes = Buffer.concat([header, ...chunks]);
  bytes.writeUInt32LE(bytes.length, 8);
  return bytes;
}

function jsonChunk(text) {
  const data = Buffer.from(text, 'utf8');
  return chunk('JSON', Buffer.concat([data, Buffer.alloc((4 - data.length % 4) % 4, ' ')]));
}

export function joinGlb(json, binary) {
  return container([jsonChunk(JSON.stringify(json)), chunk('BIN\0', binary)]);
}

// Each: name, what both tools must find, as "CODE pointer" and " (warning)" if it is one, and the
// change. `a` is the accessor of the indices, `p` of the positions, `n` of the normals; `views` are
// the vertices', the triangles' and the payload's.
const VERTICES = 0, TRIANGLES = 1, PAYLOAD = 2;
const POSITIONS = '/meshes/0/primitives/0/attributes/POSITION';
const NORMALS = '/meshes/0/primitives/0/attributes/NORMAL';
const INDICES = '/meshes/0/primitives/0/indices';

const JSON_DEFECTS = [
  ['version missing', 'UNDEFINED_PROPERTY /asset', (j) => { delete j.asset.version; }],
  ['version of another form', 'PATTERN_MISMATCH /asset/version', (j) => { j.asset.version = '2'; }],
  ['version 2.1', 'UNKNOWN_ASSET_MINOR_VERSION /asset/version (warning)',
   (j) => { j.asset.version = '2.1'; }],
  ['version 1', 'UNKNOWN_ASSET_MAJOR_VERSION /asset/version', (j) => { j.asset.version = '1.0'; }],
  ['scene unresolved', 'UNRESOLVED_REFERENCE /scene', (j) => { j.scene = 7; }],
  ['scenes empty', 'EMPTY_ENTITY /scenes', (j) => { j.scenes = []; }],
  ['scene of another type', 'TYPE_MISMATCH /scenes/0', (j) => { j.scenes[0] = 3; }],
  ['scene lists a node twice', 'DUPLICATE_ELEMENTS /scenes/0/nodes/1',
   (j) => { j.scenes[0].nodes = [0, 0]; }],
  ['scene lists no index', 'INVALID_INDEX /scenes/0/nodes/1',
   (j) => { j.scenes[0].nodes = [0, 'a']; }],
  ['scene lists a child', 'SCENE_NON_ROOT_NODE /scenes/0/nodes/0',
   (j) => { j.nodes.push({ children: [0] }); }],
  ['node in itself', 'NODE_LOOP /nodes/0', (j) => { j.nodes[0].children = [0]; }],
  ['nodes in a loop', 'NODE_LOOP /nodes/2',
   (j) => { j.nodes.push({ children: [2] }, { children: [3] }, { children: [1] }); }],
  ['node of two parents', 'NODE_PARENT_OVERRIDE /nodes/3/children/0',
   (j) => { j.nodes.push({ children: [2] }, {}, { children: [2] }); }],
  ['child unresolved', 'UNRESOLVED_REFERENCE /nodes/0/children/0',
   (j) => { j.nodes[0].children = [9]; }],
  ['mesh unresolved', 'UNRESOLVED_REFERENCE /nodes/0/mesh', (j) => { j.nodes[0].mesh = 1; }],
  ['matrix too short', 'ARRAY_LENGTH_NOT_IN_LIST /nodes/0/matrix',
   (j) => { j.nodes[0].matrix = [1, 0]; }],
  ['matrix and scale', 'NODE_MATRIX_TRS /nodes/0/matrix', (j) => {
    j.nodes[0].matrix = [2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
    j.nodes[0].scale = [1, 1, 1];
  }],
  ['scale of no number', 'ARRAY_TYPE_MISMATCH /nodes/0/scale',
   (j) => { j.nodes[0].scale = [1, 'a', 1]; }],
  ['rotation too long', 'ROTATION_NON_UNIT /nodes/0/rotation',
   (j) => { j.nodes[0].rotation = [1, 1, 0, 0]; }],
  ['rotation beyond 1', 'VALUE_NOT_IN_RANGE /nodes/0/rotation/3',
   (j) => { j.nodes[0].rotation = [0, 0, 0, 2]; }],
  ['primitives missing', 'UNDEFINED_PROPERTY /meshes/0', (j) => { delete j.meshes[0].primitives; }],
  ['primitive of another type', 'ARRAY_TYPE_MISMATCH /meshes/0/primitives',
   (j) => { j.meshes[0].primitives.push(1); }],
  ['attributes missing', 'UNDEFINED_PROPERTY /meshes/0/primitives/0',
   (j) => { delete j.meshes[0].primitives[0].attributes; }],
  ['attribute unknown', 'MESH_PRIMITIVE_INVALID_ATTRIBUTE /meshes/0/primitives/0/attributes/FOO',
   (j) => { j.meshes[0].primitives[0].attributes.FOO = 1; }],
  ['attribute of large integers',
   'MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_UNSIGNED_INT /meshes/0/primitives/0/attributes/_ID', (j) => {
     j.meshes[0].primitives[0].attributes._ID = 3;
     j.accessors.push({ bufferView: 0, componentType: 5125, count: 4, type: 'SCALAR' });
   }],
  ['no positions', 'MESH_PRIMITIVE_NO_POSITION /meshes/0/primitives/0/attributes (warning)',
   (j) => { delete j.meshes[0].primitives[0].attributes.POSITION; }],
  ['indices of no triangle', 'MESH_PRIMITIVE_INCOMPATIBLE_MODE /meshes/0/primitives/0 (warning)',
   (j, { a }) => { a.count = 11; }],
  ['attribute unresolved', `UNRESOLVED_REFERENCE ${POSITIONS}`,
   (j) => { j.meshes[0].primitives[0].attributes.POSITION = 9; }],
  ['indices unresolved', `UNRESOLVED_REFERENCE ${INDICES}`,
   (j) => { j.meshes[0].primitives[0].indices = 9; }],
  ['material unresolved', 'UNRESOLVED_REFERENCE /meshes/0/primitives/0/material',
   (j) => { j.meshes[0].primitives[0].material = 9; }],
  ['mode out of range', 'VALUE_NOT_IN_RANGE /meshes/0/primitives/0/mode',
   (j) => { j.meshes[0].primitives[0].mode = 7; }],
  ['positions as indices', `ACCESSOR_USAGE_OVERRIDE ${INDICES}`,
   (j) => { j.meshes[0].primitives[0].indices = 1; }],
  ['fewer positions than normals', `MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT ${NORMALS}`,
   (j, { p }) => { p.count = 3; }],
  ['fewer vertices than indices name', `ACCESSOR_INDEX_OOB ${INDICES}`,
   (j, { p, n }) => { p.count = 3; n.count = 3; }],
  ['accessor of an unknown type', 'VALUE_NOT_IN_LIST /accessors/1/type (warning)',
   (j, { p }) => { p.type = 'VEC5'; }],
  ['accessor without count', 'UNDEFINED_PROPERTY /accessors/1', (j, { p }) => { delete p.count; }],
  ['accessor of no elements', 'VALUE_NOT_IN_RANGE /accessors/1/count',
   (j, { p }) => { p.count = 0; }],
  ['accessor too long', 'ACCESSOR_TOO_LONG /accessors/1',
   (j, { p, n }) => { p.count = n.count = 5; }],
  ['accessor far too long', 'ACCESSOR_TOO_LONG /accessors/1', (j, { p }) => { p.count = 1e15; }],
  ['accessor begins behind its view', 'ACCESSOR_TOO_LONG /accessors/1/byteOffset',
   (j, { p }) => { p.byteOffset = 1000; }],
  ['accessor misaligned', 'ACCESSOR_OFFSET_ALIGNMENT /accessors/1/byteOffset',
   (j, { p }) => { p.byteOffset = 2; }],
  ['view misaligned', 'ACCESSOR_TOTAL_OFFSET_ALIGNMENT /accessors/1',
   (j, { views }) => { views[VERTICES].byteOffset = 2; }],
  ['accessor of no view with an offset', 'UNSATISFIED_DEPENDENCY /accessors/2/byteOffset',
   (j, { n }) => { delete n.bufferView; }],
  ['accessor of an unknown view', 'UNRESOLVED_REFERENCE /accessors/1/bufferView',
   (j, { p }) => { p.bufferView = 9; }],
  ['positions without min', `MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS ${POSITIONS}`,
   (j, { p }) => { delete p.min; }],
  ['min too short', 'ARRAY_LENGTH_NOT_IN_LIST /accessors/1/min', (j, { p }) => { p.min = [0]; }],
  ['min too small', 'ACCESSOR_MIN_MISMATCH /accessors/1/min/0', (j, { p }) => { p.min[0] -= 1; }],
  ['min too large', 'ACCESSOR_ELEMENT_OUT_OF_MIN_BOUND /accessors/1/min/1',
   (j, { p }) => { p.min[1] += 0.1; }],
  ['max too large', 'ACCESSOR_MAX_MISMATCH /accessors/1/max/2', (j, { p }) => { p.max[2] += 1; }],
  ['max too small', 'ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND /accessors/1/max/2',
   (j, { p }) => { p.max[2] -= 1; }],
  ['positions of integers', `MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT ${POSITIONS}`,
   (j, { p }) => { p.componentType = 5125; }],
  ['min beyond its type', 'INVALID_GL_VALUE /accessors/1/min',
   (j, { p }) => { p.componentType = 5125; }],
  ['floats normalized', 'ACCESSOR_NORMALIZED_INVALID /accessors/1/normalized',
   (j, { p }) => { p.normalized = true; }],
  ['positions in a plane', `MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT ${POSITIONS}`,
   (j, { p }) => { p.type = 'VEC2'; p.min.pop(); p.max.pop(); }],
  ['indices signed', `MESH_PRIMITIVE_INDICES_ACCESSOR_INVALID_FORMAT ${INDICES}`,
   (j, { a }) => { a.componentType = 5120; }],
  ['view too long', 'BUFFER_VIEW_TOO_LONG /bufferViews/2/byteLength',
   (j, { views }) => { views[PAYLOAD].byteLength += 1; }],
  ['view behind its buffer', 'BUFFER_VIEW_TOO_LONG /bufferViews/2/byteOffset',
   (j, { views }) => { views[PAYLOAD].byteOffset = 1e9; }],
  ['view of an unknown buffer', 'UNRESOLVED_REFERENCE /bufferViews/0/buffer',
   (j, { views }) => { views[VERTICES].buffer = 1; }],
  ['stride odd', 'VALUE_MULTIPLE_OF /bufferViews/2/byteStride',
   (j, { views }) => { views[PAYLOAD].byteStride = 13; }],
  ['stride below an element', 'ACCESSOR_SMALL_BYTESTRIDE /accessors/1',
   (j, { views }) => { views[VERTICES].byteStride = 8; }],
  ['stride beyond the view', 'BUFFER_VIEW_TOO_BIG_BYTE_STRIDE /bufferViews/0/byteStride',
   (j, { views }) => { views[VERTICES].byteStride = 200; }],
  ['stride of indices', `MESH_PRIMITIVE_INDICES_ACCESSOR_WITH_BYTESTRIDE ${INDICES}`,
   (j, { views }) => { views[TRIANGLES].byteStride = 4; }],
  ['stride missing', `MESH_PRIMITIVE_ACCESSOR_WITHOUT_BYTESTRIDE ${NORMALS}`,
   (j, { views }) => { delete views[VERTICES].byteStride; }],
  ['target of indices', `BUFFER_VIEW_TARGET_OVERRIDE ${POSITIONS}`,
   (j, { views }) => { views[VERTICES].target = 34963; }],
  ['buffer of no bytes', 'VALUE_NOT_IN_RANGE /buffers/0/byteLength',
   (j) => { j.buffers[0].byteLength = 0; }],
  ['buffer longer than its data', 'BUFFER_BYTE_LENGTH_MISMATCH /buffers/0',
   (j) => { j.buffers[0].byteLength += 4; }],
  ['file missing', 'IO_ERROR /buffers/0/uri', (j) => { j.buffers[0].uri = 'missing.bin'; }],
  ['data URI too short', 'BUFFER_BYTE_LENGTH_MISMATCH /buffers/0',
   (j) => { j.buffers[0].uri = 'data:application/octet-stream;base64,AAAA'; }],
  ['data URI of no data', 'INVALID_URI /buffers/0/uri', (j) => { j.buffers[0].uri = 'data:foo'; }],
  ['buffer shorter than the BIN chunk', 'BUFFER_GLB_CHUNK_TOO_BIG /buffers/0 (warning)',
   (j) => { j.buffers[0].byteLength -= 8; }],
  ...['/asset', '/scenes/0', '/nodes/0', '/meshes/0', '/meshes/0/primitives/0', '/accessors/1',
      '/bufferViews/2', '/buffers/0', '/materials/0', '/materials/0/pbrMetallicRoughness',
      ''].map((place) => [
    `unknown property in ${place}`, `UNEXPECTED_PROPERTY ${place}/foo (warning)`,
    (j) => { place.split('/').slice(1).reduce((value, key) => value[key], j).foo = 1; }]),
  ['extension not declared',
   'UNDECLARED_EXTENSION /meshes/0/extensions/ZEROTREE_mesh_progressive',
   (j) => { delete j.extensionsUsed; }],
  ['extension declared twice', 'DUPLICATE_ELEMENTS /extensionsUsed/1',
   (j) => { j.extensionsUsed.push(j.extensionsUsed[0]); }],
  ['extension of no name', 'ARRAY_TYPE_MISMATCH /extensionsUsed/1',
   (j) => { j.extensionsUsed.push(3); }],
  ['extension required, not used', 'UNUSED_EXTENSION_REQUIRED /extensionsRequired/0',
   (j) => { j.extensionsRequired = ['KHR_mesh_quantization']; }],
  ['extension used, not required', 'NON_REQUIRED_EXTENSION /extensionsUsed/1',
   (j) => { j.extensionsUsed.push('KHR_mesh_quantization'); }],
  ['extensions required, none used', 'UNSATISFIED_DEPENDENCY /extensionsRequired', (j) => {
    j.extensionsRequired = j.extensionsUsed;
    delete j.extensionsUsed;
  }],
];

const DATA_DEFECTS = [
  ['position not a number', 'ACCESSOR_INVALID_FLOAT /accessors/1',
   (binary) => binary.writeFloatLE(NaN, 28)],
  ['position infinite', 'ACCESSOR_INVALID_FLOAT /accessors/1',
   (binary) => binary.writeFloatLE(Infinity, 0)],
  ['position outside min', 'ACCESSOR_MIN_MISMATCH /accessors/1/min/1',
   (binary) => binary.writeFloatLE(-9, 4)],
  ['normal too long', `ACCESSOR_VECTOR3_NON_UNIT ${NORMALS}`,
   (binary) => binary.writeFloatLE(2, 24 + 12)],
  ['index out of range', `ACCESSOR_INDEX_OOB ${INDICES}`,
   (binary, view) => binary.writeUInt8(4, view.byteOffset + 5)],
  ['index that restarts', `ACCESSOR_INDEX_PRIMITIVE_RESTART ${INDICES}`,
   (binary, view) => binary.writeUInt8(255, view.byteOffset + 11)],
];

const CONTAINER_DEFECTS = [
  ['GLB of version 1', 'GLB_INVALID_VERSION ', (b) => b.writeUInt32LE(1, 4)],
  ['GLB length too large', 'GLB_LENGTH_MISMATCH ', (b) => b.writeUInt32LE(b.length + 4, 8)],
  ['GLB length too small', 'GLB_CHUNK_TOO_BIG ', (b) => b.writeUInt32LE(b.length - 4, 8)],
  ['GLB of no length', 'GLB_LENGTH_TOO_SMALL ', (b) => b.writeUInt32LE(0, 8)],
  ['BIN chunk too big', 'GLB_CHUNK_TOO_BIG ',
   (b, bin) => b.writeUInt32LE(b.readUInt32LE(bin) + 4, bin)],
  ['BIN chunk unaligned', 'GLB_CHUNK_LENGTH_UNALIGNED ',
   (b, bin) => b.writeUInt32LE(b.readUInt32LE(bin) - 1, bin)],
  ['two JSON chunks', 'GLB_DUPLICATE_CHUNK ', (b, bin) => b.write('JSON', bin + 4, 'latin1')],
  ['chunk of another type', 'GLB_UNKNOWN_CHUNK_TYPE  (warning)',
   (b, bin) => b.write('ABCD', bin + 4, 'latin1')],
  ['no BIN chunk', 'BUFFER_MISSING_GLB_DATA /buffers/0',
   (b, bin) => b.write('ABCD', bin + 4, 'latin1')],
];

function cuts(base) {
  const bin = 20 + base.readUInt32LE(12);
  const cut = (name, expected, length) => ({ name, expected, bytes: base.subarray(0, length) });
  return [
    cut('cut in the header', 'GLB_UNEXPECTED_END_OF_HEADER ', 10),
    cut('cut behind the header', 'GLB_LENGTH_MISMATCH ', 12),
    cut('cut in the JSON', 'GLB_UNEXPECTED_END_OF_CHUNK_DATA ', 99),
    cut('cut behind the JSON', 'GLB_LENGTH_MISMATCH ', bin),
    cut('cut in the header of BIN', 'GLB_UNEXPECTED_END_OF_CHUNK_HEADER ', bin + 4),
    cut('cut in the payload', 'GLB_UNEXPECTED_END_OF_CHUNK_DATA ', base.length - 8),
  ];
}

function containers({ json, binary }) {
  const jsonPart = jsonChunk(JSON.stringify(json)), binaryPart = chunk('BIN\0', binary);
  const other = chunk('ABCD', Buffer.alloc(4));
  return [
    { name: 'BIN chunk first', expected: 'GLB_UNEXPECTED_FIRST_CHUNK ',
      bytes: container([binaryPart, jsonPart]) },
    { name: 'BIN chunk third', expected: 'GLB_UNEXPECTED_BIN_CHUNK ',
      bytes: container([jsonPart, other, binaryPart]) },
    { name: 'empty JSON chunk', expected: 'GLB_EMPTY_CHUNK ',
      bytes: container([chunk('JSON', Buffer.alloc(0)), binaryPart]) },
    { name: 'more behind the GLB', expected: 'GLB_EXTRA_DATA  (warning)',
      bytes: Buffer.concat([container([jsonPart, binaryPart]), Buffer.alloc(8)]) },
    { name: 'two BIN chunks', expected: 'GLB_DUPLICATE_CHUNK ',
      bytes: container([jsonPart, binaryPart, binaryPart]) },
    { name: 'JSON cut short', expected: 'INVALID_JSON ',
      bytes: container([jsonChunk('{"asset":{'), binaryPart]) },
    { name: 'JSON with a byte order mark', expected: 'INVALID_JSON ',
      bytes: container([jsonChunk('\ufeff' + JSON.stringify(json)), binaryPart]) },
    { name: 'JSON and more', expected: 'INVALID_JSON ',
      bytes: container([jsonChunk(JSON.stringify(json) + '\0x'), binaryPart]) },
    { name: 'JSON of another type', expected: 'TYPE_MISMATCH ',
      bytes: container([jsonChunk('[]'), binaryPart]) },
    { name: 'BIN chunk too short', expected: 'BUFFER_BYTE_LENGTH_MISMATCH /buffers/0',
      bytes: container([jsonPart, chunk('BIN\0', binary.subarray(0, binary.length - 40))]) },
  ];
}

/// All of them: { name, expected: "CODE pointer", bytes }.
export function brokenFiles(base) {
  const { json, binary } = splitGlb(base);
  const files = [...containers({ json, binary }), ...cuts(base)];
  for (const [name, expected, change] of JSON_DEFECTS) {
    const copy = structuredClone(json);
    const [a, p, n] = copy.accessors;
    change(copy, { a, p, n, views: copy.bufferViews });
    files.push({ name, expected, bytes: joinGlb(copy, binary) });
  }
  for (const [name, expected, change] of DATA_DEFECTS) {
    const copy = Buffer.from(binary);
    change(copy, json.bufferViews[TRIANGLES]);
    files.push({ name, expected, bytes: joinGlb(json, copy) });
  }
  for (const [name, expected, change] of CONTAINER_DEFECTS) {
    const copy = Buffer.from(base);
    change(copy, 20 + base.readUInt32LE(12));
    files.push({ name, expected, bytes: copy });
  }
  return files;
}

const REPLACEMENTS = [null, true, -1, 0, 1, 7, 0.5, 1e9, 1e15, 'abc', [], {}, [[1]]];

// Every value of the document but those of the progressive extension, as [parent, key, pointer].
function* places(value, pointer) {
  if (typeof value !== 'object' || value === null) return;
  for (const key of Object.keys(value)) {
    const at = `${pointer}/${key}`;
    yield [value, key, at];
    if (!at.endsWith('/extensions')) yield* places(value[key], at);
  }
}

/// Files with the value at `pointer` of the JSON replaced or removed: { name, pointer, bytes }.
export function mutatedFiles(base) {
  const { json, binary } = splitGlb(base);
  const files = [];
  for (const [parent, key, pointer] of places(json, '')) {
    const value = parent[key];
    for (const replacement of REPLACEMENTS) {
      parent[key] = replacement;
      files.push({ pointer, name: `${pointer} = ${JSON.stringify(replacement)}`,
                   bytes: joinGlb(json, binary) });
    }
    if (!Array.isArray(parent)) {
      parent[key] = undefined;  // which JSON leaves out, and the order of the others stays
      files.push({ pointer, name: `${pointer} removed`, bytes: joinGlb(json, binary) });
    }
    parent[key] = value;
  }
  return files;
}
