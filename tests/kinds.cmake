# SPDX-License-Identifier: Apache-2.0
# Test cases of a kind of their own, by program: KIND_PROGRAM, in the words of --gtest_filter. The
# kind is added to their label.

# `exact`: they compare, without clock or chance; what fails once is not run again.
set(exact_comms-tests Cdr/* FragmentsTest.* PiecesTest.*)
set(exact_comms-order-tests *)
set(exact_comms-network-tests Wire.*)
set(exact_cs-tests *SafeDemands* *SafeStop* *DemandsAtRest.* *DemandQuality.* *AcceptedDemands.*
    *HandOver*)
set(exact_determinism-tests Shards/*)

# `long`: the same each time, but dear. With a share of the work the gate has others like them.
set(long_core-tests TypeModel.BoundsWhatInheritanceMultiplies HostileXml.ManyUnknownNamesCostLittle)
set(long_core-command-tests *LeaseFight.*)
set(long_cli-tests FindingsPage.ExplainsEveryRuleThatASourceNames
    CortexTypes.PrintsEveryTypeAsJsonOfTheCommittedSchema CortexNewType.MakesFiles*)
set(long-exact_determinism-tests Shards/*/2 Shards/*/3)
set(long_gui-tests EventRows.ARowOfManyOpensToEachOfThem)
set(long_integration-tests LbrTeleop/FlippedJoint.*/1 LbrTeleop/FlippedJoint.*/2
    LbrTeleop/FlippedJoint.*/3 LbrTeleop/FlippedJoint.*/4 LbrTeleop/FlippedJoint.*/5
    LbrTeleop/FlippedJoint.*/6 LbrTeleop.FollowReplacedByHold*)

# `timed`: they judge time, or need CPUs that nobody else uses, or take them all with a priority.
set(timed_cs-tests *CostlyTasks.* ClusterCS.SharesCostlyTasks* ClusterCS.GivesItsPriority*
    ThreadPool.EndsEveryCycleWithMoreRealtimeThreadsThanCpus*)
set(timed_gui-session-tests Session.TakesValues*)
set(timed_network-tests AttackedPlant.* TwoHosts.* Stations.*)
set(timed_process-tests EndOfAProcess.* TwoAgents.*Killed* TwoAgents.*Hold*
    RetainedValues.LoseAtMost*)
