// SPDX-License-Identifier: Apache-2.0
#pragma once

// The short names of what can be found in model files and types (Finding::rule); each has its
// meaning and remedy in docs/findings.md. Names are never changed, only added.
namespace cortex::finding {

// Files and XML
inline constexpr char fileMissing[] = "file-missing";
inline constexpr char fileKind[] = "file-kind";
inline constexpr char fileSize[] = "file-size";
inline constexpr char fileCount[] = "file-count";
inline constexpr char includeLoop[] = "include-loop";
inline constexpr char xmlSyntax[] = "xml-syntax";
inline constexpr char xmlEncoding[] = "xml-encoding";
inline constexpr char xmlDoctype[] = "xml-doctype";
inline constexpr char xmlEntity[] = "xml-entity";
inline constexpr char xmlNesting[] = "xml-nesting";
inline constexpr char xmlElements[] = "xml-elements";
inline constexpr char xmlText[] = "xml-text";
inline constexpr char unknownElement[] = "unknown-element";
inline constexpr char unknownAttribute[] = "unknown-attribute";
inline constexpr char missingAttribute[] = "missing-attribute";
inline constexpr char attributeValue[] = "attribute-value";
inline constexpr char repeatedElement[] = "repeated-element";

// Types
inline constexpr char name[] = "name";
inline constexpr char reservedName[] = "reserved-name";
inline constexpr char textLength[] = "text-length";
inline constexpr char modelSize[] = "model-size";
inline constexpr char duplicateType[] = "duplicate-type";
inline constexpr char unknownType[] = "unknown-type";
inline constexpr char unknownParent[] = "unknown-parent";
inline constexpr char duplicateParent[] = "duplicate-parent";
inline constexpr char parentCycle[] = "parent-cycle";
inline constexpr char inheritanceDepth[] = "inheritance-depth";
inline constexpr char roleConflict[] = "role-conflict";
inline constexpr char roleChanged[] = "role-changed";
inline constexpr char writersChanged[] = "writers-changed";
inline constexpr char commandRole[] = "command-role";
inline constexpr char longActivity[] = "long-activity";
inline constexpr char transitionTimeout[] = "transition-timeout";
inline constexpr char typeDescription[] = "type-description";
inline constexpr char typeHash[] = "type-hash";

// Data items and parameters
inline constexpr char duplicateData[] = "duplicate-data";
inline constexpr char kindMissing[] = "kind-missing";
inline constexpr char kindChanged[] = "kind-changed";
inline constexpr char lengthChanged[] = "length-changed";
inline constexpr char lengthBounds[] = "length-bounds";
inline constexpr char capacityChanged[] = "capacity-changed";
inline constexpr char capacityBounds[] = "capacity-bounds";
inline constexpr char capacityKind[] = "capacity-kind";
inline constexpr char unit[] = "unit";
inline constexpr char unitChanged[] = "unit-changed";
inline constexpr char unitOpen[] = "unit-open";
inline constexpr char unitKind[] = "unit-kind";
inline constexpr char rangeKind[] = "range-kind";
inline constexpr char rangeEmpty[] = "range-empty";
inline constexpr char rangeWidened[] = "range-widened";
inline constexpr char rate[] = "rate";
inline constexpr char rateWidened[] = "rate-widened";
inline constexpr char derivative[] = "derivative";
inline constexpr char stopPair[] = "stop-pair";
inline constexpr char stopRate[] = "stop-rate";
inline constexpr char limitPair[] = "limit-pair";
inline constexpr char above[] = "above";
inline constexpr char resolution[] = "resolution";
inline constexpr char defaultKind[] = "default-kind";
inline constexpr char defaultRange[] = "default-range";
inline constexpr char defaultAbove[] = "default-above";
inline constexpr char labels[] = "labels";
inline constexpr char labelChanged[] = "label-changed";
inline constexpr char safeMissing[] = "safe-missing";
inline constexpr char safeKind[] = "safe-kind";
inline constexpr char safeRange[] = "safe-range";
inline constexpr char atRest[] = "at-rest";
inline constexpr char settableConstant[] = "settable-constant";
inline constexpr char settableWidened[] = "settable-widened";
inline constexpr char retain[] = "retain";
inline constexpr char flagChanged[] = "flag-changed";
inline constexpr char limitLoosened[] = "limit-loosened";
inline constexpr char parameterAttribute[] = "parameter-attribute";

// Commands
inline constexpr char duplicateCommand[] = "duplicate-command";
inline constexpr char duplicateParameter[] = "duplicate-parameter";
inline constexpr char parametersChanged[] = "parameters-changed";
inline constexpr char availabilityWidened[] = "availability-widened";
inline constexpr char longChanged[] = "long-changed";
inline constexpr char confirmLoosened[] = "confirm-loosened";
inline constexpr char stopsLoosened[] = "stops-loosened";
inline constexpr char repeatedLoosened[] = "repeated-loosened";
inline constexpr char timeout[] = "timeout";
inline constexpr char recordSize[] = "record-size";

// Rules
inline constexpr char duplicateRule[] = "duplicate-rule";
inline constexpr char directionMissing[] = "direction-missing";
inline constexpr char directionChanged[] = "direction-changed";
inline constexpr char targetMissing[] = "target-missing";
inline constexpr char targetWidened[] = "target-widened";
inline constexpr char unknownTarget[] = "unknown-target";
inline constexpr char countEmpty[] = "count-empty";
inline constexpr char countWidened[] = "count-widened";
inline constexpr char unknownCreate[] = "unknown-create";
inline constexpr char createTarget[] = "create-target";
inline constexpr char createAbstract[] = "create-abstract";
inline constexpr char delayedLoosened[] = "delayed-loosened";
inline constexpr char refines[] = "refines";
inline constexpr char counterpart[] = "counterpart";
inline constexpr char sameCount[] = "same-count";
inline constexpr char onLossDirection[] = "on-loss-direction";
inline constexpr char maxAge[] = "max-age";

// One name from several parents
inline constexpr char intersectionEmpty[] = "intersection-empty";
inline constexpr char restate[] = "restate";

// Systems
inline constexpr char duplicatePath[] = "duplicate-path";
inline constexpr char duplicateCluster[] = "duplicate-cluster";
inline constexpr char duplicateSetting[] = "duplicate-setting";
inline constexpr char phaseRange[] = "phase-range";

}  // namespace cortex::finding
