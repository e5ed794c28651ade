#include "stream_facts.hpp"

#include "base/bits.hpp"
#include "base/checksum.hpp"

#include <array>
#include <cstdio>
#include <iomanip>
#include <sstream>

#include <tvg/decoder.hpp>

namespace tvg::conformance {

namespace {

/// Digests four bytes of each value, least significant first on every machine.
void add(Hasher& hasher, const auto& values) {
  std::vector<std::int32_t> words;
  for (const auto value : values) words.push_back(bits_as<std::int32_t>(value));
  hasher.update(words);
}

void add_number(Hasher& hasher, std::size_t number) {
  add(hasher, std::array{static_cast<std::uint32_t>(number)});
}

void add_text(Hasher& hasher, const std::string& text) {
  add_number(hasher, text.size());
  hasher.update(std::vector<std::uint8_t>(text.begin(), text.end()));
}

void add(Hasher& hasher, const MeshProperties& properties) {
  if (properties.empty()) return;
  add_number(hasher, properties.attributes.size());
  for (const Attribute& attribute : properties.attributes) {
    add_number(hasher, static_cast<std::size_t>(attribute.kind));
    add_number(hasher, static_cast<std::size_t>(attribute.domain));
    add_number(hasher, attribute.components);
    add_number(hasher, static_cast<std::size_t>(attribute.bits));
    add_text(hasher, attribute.name);
    add_number(hasher, attribute.value_count());
    add(hasher, attribute.values);
    add(hasher, attribute.corners);
  }
  add_number(hasher, properties.parts.size());
  for (const Part& part : properties.parts) {
    for (const std::string* const name : {&part.object, &part.group, &part.material}) add_text(hasher, *name);
  }
  add(hasher, properties.face_parts);
  add_number(hasher, properties.polygons.size());
  for (const Polygon& polygon : properties.polygons) {
    add_number(hasher, polygon.first_triangle);
    add_number(hasher, polygon.corners);
  }
}

}  // namespace

Result<StreamFacts> read_stream_facts(std::span<const std::uint8_t> stream, std::uint32_t lod) {
  Decoder decoder;
  decoder.use_lod(lod);
  decoder.push(stream);
  decoder.finish();
  StreamFacts facts;
  facts.bytes = stream.size();
  Mesh shown;
  MeshProperties shown_properties;
  Hasher lattice, positions, faces, properties;
  std::vector<std::int32_t> indices;
  std::vector<float> coordinates;
  for (;;) {
    switch (decoder.poll()) {
      case Decoder::Event::kFrame:
        // A mesh counts when a frame has another than the one before it.
        if (facts.frames == 0 || decoder.mesh() != shown) {
          shown = decoder.mesh();
          facts.vertices += shown.vertex_count;
          facts.faces += shown.faces.size();
          for (const Face& face : shown.faces) add(faces, face);
          indices.resize(3 * std::size_t{shown.vertex_count});
          coordinates.resize(indices.size());
        }
        if (decoder.properties() != shown_properties) {
          shown_properties = decoder.properties();
          add(properties, shown_properties);
        }
        for (std::size_t i = 0; i < shown_properties.attributes.size(); ++i)
          add(properties, decoder.animated_values(i));
        ++facts.frames;
        decoder.copy_lattice(indices);
        decoder.copy_positions(coordinates.data());
        lattice.update(indices);
        add(positions, coordinates);
        break;
      case Decoder::Event::kDamage:
        return decoder.damage().error;
      case Decoder::Event::kError:
        return decoder.error();
      case Decoder::Event::kNeedBytes:
        return Error{ErrorCode::kTruncated, "the decoder asks for bytes behind the end", {}, {}, ""};
      case Decoder::Event::kEnd:
        facts.lattice_digest = lattice.value();
        facts.positions_digest = positions.value();
        facts.faces_digest = faces.value();
        facts.properties_digest = properties.value();
        return facts;
      default:
        break;
    }
  }
}

std::string lod_name(const std::string& stream, std::uint32_t lod) {
  return stream + "@" + std::to_string(lod);
}

std::string facts_heading() {
  return "# stream bytes frames vertices faces xxh64(lattice) xxh64(positions) xxh64(faces) "
         "xxh64(properties)";
}

std::string facts_line(const NamedFacts& entry) {
  const StreamFacts& facts = entry.facts;
  std::ostringstream line;
  line << entry.name << ' ' << facts.bytes << ' ' << facts.frames << ' ' << facts.vertices << ' '
       << facts.faces << std::hex << std::setfill('0');
  for (const std::uint64_t digest :
       {facts.lattice_digest, facts.positions_digest, facts.faces_digest, facts.properties_digest}) {
    line << ' ' << std::setw(16) << digest;
  }
  return line.str();
}

std::vector<NamedFacts> read_facts(std::istream& file) {
  std::vector<NamedFacts> entries;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream cells(line);
    NamedFacts entry;
    StreamFacts& facts = entry.facts;
    cells >> entry.name >> facts.bytes >> facts.frames >> facts.vertices >> facts.faces >> std::hex >>
        facts.lattice_digest >> facts.positions_digest >> facts.faces_digest >> facts.properties_digest;
    if (cells) entries.push_back(entry);
  }
  return entries;
}

}  // namespace tvg::conformance
