// SPDX-License-Identifier: Apache-2.0
#include "start_check.hpp"

#include "cortex/core/agent.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/findings_json.hpp"
#include "cortex/core/sending_checks.hpp"
#include "cortex/core/system_findings.hpp"
#include "cortex/cs/cluster_cs.hpp"
#include "cortex/toolkit/classes.hpp"

#include "dry_start.hpp"
#include "read_system.hpp"

#include <nlohmann/json.hpp>

namespace cortex::toolkit {
namespace {

void lookForFindings(const CommandLine& line, Report& report) {
    ClassRegistry registry;
    addClasses(registry);
    const OwnedTree tree = readSystem(line, registry);
    dryStart(line, registry, *tree, [&](cs::ClusterCS& cluster) {
        report.append(cluster.agent().warnings());
        if (!line.offline) report.append(checkSending(*tree, cluster.agent().structure()));
    });
}

Report startFindings(const CommandLine& line) {
    Report report;
    const auto refused = [&](const std::string& why) {
        report.error("", finding::startRefused, {line.system.string(), 0}, why);
    };
    try {
        lookForFindings(line, report);
    } catch (const UsageError&) {
        throw;
    } catch (const ModelError& error) {
        report.append(error.report());
    } catch (const std::exception& error) {
        refused(error.what());
    } catch (...) {
        refused("a plug-in threw what is no std::exception");
    }
    return report;
}

}  // namespace

bool printStartFindings(const CommandLine& line) {
    using Json = nlohmann::ordered_json;
    const OutputAside output;
    cs::blockStopSignals();  // a hook that does not return is named
    const Report report = startFindings(line);
    const Json json{{"findings", findingsJson<Json>(report)}};
    output.write(json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
    return report.ok();
}

}  // namespace cortex::toolkit
