// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace cortex::fuzz {

// A folder of its own for one fuzz process; the input is written to a file in it.
class Folder {
public:
    Folder() {
        std::string name = (std::filesystem::temp_directory_path() / "cortex-fuzz-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) std::abort();
        path_ = name;
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::filesystem::path write(const char* name, std::string_view text) const {
        const auto file = path_ / name;
        std::ofstream(file, std::ios::binary) << text;
        return file;
    }

private:
    std::filesystem::path path_;
};

inline std::string_view text(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

// What morphology and system inputs can build upon, included as "types.xml" and "rules.xml".
inline constexpr std::string_view types = R"(<ontology name="t" version="1">
  <type name="Simplex" abstract="true"/>
  <type name="Axis" extends="Simplex" role="modification">
    <data name="position" kind="float" unit="rad" min="-1" max="1" default="0" safe="hold" rate="2"/>
  </type>
  <type name="Active" extends="Simplex" role="active" abstract="true">
    <data name="state" kind="int" labels="0:Standby 1:StartingUp 2:Active 3:ShuttingDown 4:Fault"/>
  </type>
  <type name="Sine" extends="Active">
    <data name="amplitude" kind="float" min="0" max="1" default="0.5" settable="always"/>
    <data name="name" kind="string" capacity="16"/>
    <command name="zero"><request name="to" kind="float" default="0"/></command>
  </type>
</ontology>
)";
inline constexpr std::string_view rules = R"(<morphology name="r">
  <include file="types.xml"/>
  <rules type="Sine">
    <relationship name="axis" direction="output" target="Axis" min="1" max="2" create="Axis"/>
    <relationship name="seen" direction="input" target="Axis" delayed="true"/>
  </rules>
</morphology>
)";

}  // namespace cortex::fuzz
