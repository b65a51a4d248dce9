// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/findings.hpp"

// What validate() and the tree find in a system, beside what its files and types are found to be.
// Names are never changed, only added.
namespace cortex::finding {

// The agent
inline constexpr char agentType[] = "agent-type";
inline constexpr char noClusterType[] = "no-cluster-type";
inline constexpr char clusterPath[] = "cluster-path";
inline constexpr char dataSize[] = "data-size";

// A simplex
inline constexpr char malformedPath[] = "malformed-path";
inline constexpr char abstractType[] = "abstract-type";
inline constexpr char everyRange[] = "every-range";
inline constexpr char createdPath[] = "created-path";
inline constexpr char noClass[] = "no-class";
inline constexpr char startRefused[] = "start-refused";
inline constexpr char startUnchecked[] = "start-unchecked";
inline constexpr char populate[] = "populate";
inline constexpr char startValueOverwritten[] = "start-value-overwritten";
inline constexpr char startValueInVain[] = "start-value-in-vain";
inline constexpr char settingsRefused[] = "settings-refused";
inline constexpr char noHandler[] = "no-handler";
inline constexpr char argumentNotSet[] = "argument-not-set";
inline constexpr char everyWithoutTask[] = "every-without-task";

// A relationship
inline constexpr char unknownRule[] = "unknown-rule";
inline constexpr char unknownPath[] = "unknown-path";
inline constexpr char targetType[] = "target-type";
inline constexpr char targetTwice[] = "target-twice";
inline constexpr char belowMin[] = "below-min";
inline constexpr char aboveMax[] = "above-max";
inline constexpr char countUnequal[] = "count-unequal";
inline constexpr char remoteOutput[] = "remote-output";
inline constexpr char remoteTypes[] = "remote-types";

// A setting
inline constexpr char unknownItem[] = "unknown-item";
inline constexpr char settingKind[] = "setting-kind";
inline constexpr char settingLength[] = "setting-length";
inline constexpr char settingFinite[] = "setting-finite";
inline constexpr char settingRange[] = "setting-range";
inline constexpr char settingAbove[] = "setting-above";
inline constexpr char settingFramework[] = "setting-framework";

// The flow of data
inline constexpr char severalWriters[] = "several-writers";
inline constexpr char outputTwice[] = "output-twice";
inline constexpr char delayedMixed[] = "delayed-mixed";
inline constexpr char delayedDemand[] = "delayed-demand";
inline constexpr char delayedSafe[] = "delayed-safe";
inline constexpr char safeNeeded[] = "safe-needed";
inline constexpr char twoManagers[] = "two-managers";
inline constexpr char nobodyWrites[] = "nobody-writes";
inline constexpr char safeNothing[] = "safe-nothing";
inline constexpr char observedCounterpart[] = "observed-counterpart";
inline constexpr char pairUnit[] = "pair-unit";
inline constexpr char pairCrossed[] = "pair-crossed";
inline constexpr char angleRange[] = "angle-range";
inline constexpr char flowUnit[] = "flow-unit";
inline constexpr char loop[] = "loop";

}  // namespace cortex::finding
