#pragma once

namespace CLI {
class App;
}

// Each subcommand adds itself to the tool and runs when CLI11 has parsed its options. A command ends by
// returning, or by throwing ToolError.
namespace tvg::cli {

// Commands that make streams, and the one that shows what encoding goes by: encoder/.
void add_encode_command(CLI::App& tool);
void add_join_command(CLI::App& tool);
void add_ladder_command(CLI::App& tool);
void add_measure_command(CLI::App& tool);
void add_plan_command(CLI::App& tool);
void add_simplify_command(CLI::App& tool);

// Commands that read streams: decoder/.
void add_decode_command(CLI::App& tool);
void add_info_command(CLI::App& tool);
void add_verify_command(CLI::App& tool);
void add_compare_command(CLI::App& tool);

// Commands that show streams: player/ and the player of web/, and the one that offers them to others:
// server/.
void add_page_command(CLI::App& tool);
void add_play_command(CLI::App& tool);
void add_render_command(CLI::App& tool);
void add_serve_command(CLI::App& tool);

// The command that measures what streams make of animations, beside other codecs: codecs/.
void add_bench_command(CLI::App& tool);

/// Help by name; also manual pages and shells' completions, made from what the commands say of themselves.
/// `tool` has to outlive the parsing.
void add_help_command(CLI::App& tool);

}  // namespace tvg::cli
