#include "validation_document.h"

#include <algorithm>
#include <vector>

#include "gltf/issue_table.h"

namespace zerotree::test {
namespace {

using gltf::IssueText;
using gltf::Origin;

constexpr const char* kIntroduction =
    R"(<!-- Written by write_validation_document from converter/src/gltf/issue_table.cpp. -->

# Appendix D: Validation

A validator reads a file as a viewer would and names all that is wrong with it, each defect by a
code and by a JSON pointer to its place. Defects of a GLB container have an empty pointer.

It checks, in this order:

1. **The container and the JSON**: chunks of a GLB, the syntax of the JSON, keys that come twice.
   What leaves no JSON to read ends the validation.
2. **The glTF document**: properties of the asset, scenes, nodes, meshes, materials, accessors,
   bufferViews and buffers; indices that name nothing; loops of nodes; whether accessors fit into
   their bufferViews and these into their buffers; forms, alignment and values of accessors.
   Animations, cameras, images, samplers, skins, textures and morph targets are not looked into:
   the extension does not rely on them.
3. **The extension object** of each progressive mesh: [the schema](schema/README.md) and the rules
   that a schema cannot state.
4. **The base mesh**: an oriented manifold in the form that the extension allows, unpacked where it
   is compressed.
5. **The payload**: the validator compares its header with the extension object and the base mesh,
   and decodes it at every entry of `prefixes`, at no and all bytes, and at some random lengths
   drawn from the payload's bytes, so that the same file always gets the same answer. Where a
   surface is large or the table long, it decodes fewer lengths, and says so of the table.
6. **The surface of each of these prefixes**: positions are finite and in `bounds`, and seams stay
   closed. A seam is a pair of boundary edges of the base mesh that lie on each other with vertices
   of their own. Where it opens between two primitives, the surface cracks, which is an error;
   within one primitive it may be meant, and is a warning.
7. **The source**, if the mesh that was encoded is given and there is no error so far: its diagonal
   and the errors of `prefixes` are measured again. The error of an entry is broken where it is more
   than 3 % too small, and questionable where it is more than 25 % too large.
8. **Budgets**, if there are any: bytes of the file and of all files it names, stated error of the
   whole payload, and triangles of the finest surfaces.

A validator states limits beyond which it does not decode, and reports what lies beyond them as an
error: what was not checked is not valid.

| severity | number in reports | meaning |
|---|---|---|
| error | 0 | The file breaks a rule, a budget or a limit of the validator, or its surface cracks. |
| warning | 1 | The file keeps the rules, but readers may show something else than was meant. |
| information | 2 | No defect. |
| hint | 3 | No defect, but a chance to improve. |

)";

const char* severity_name(gltf::Severity severity) {
  constexpr const char* kNames[] = {"error", "warning", "information", "hint"};
  return kNames[static_cast<int>(severity)];
}

std::string table(Origin origin) {
  std::vector<IssueText> rows;
  for (const IssueText& row : gltf::issue_table())
    if (row.origin == origin) rows.push_back(row);
  std::sort(rows.begin(), rows.end(),
            [](const IssueText& a, const IssueText& b) { return std::string_view(a.id) < b.id; });
  std::string text = "| code | severity | meaning |\n|---|---|---|\n";
  for (const IssueText& row : rows)
    text.append("| `")
        .append(row.id)
        .append("` | ")
        .append(severity_name(row.severity))
        .append(" | ")
        .append(row.text)
        .append(" |\n");
  return text;
}

}  // namespace

std::string validation_document() {
  return kIntroduction + ("## Codes of this extension\n\n" + table(Origin::zerotree)) +
         "\n## Codes of glTF\n\n"
         "Codes, pointers and severities are those of Khronos' glTF-Validator. A report names a "
         "code\n"
         "once per place; glTF-Validator may name it once per value.\n\n" +
         table(Origin::gltf_validator);
}

}  // namespace zerotree::test
