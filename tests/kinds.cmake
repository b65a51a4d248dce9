# SPDX-License-Identifier: Apache-2.0
# Test cases of a kind of their own, by program: KIND_PROGRAM, in the words of --gtest_filter. The
# kind is added to their label. A name without a case is an error (gate/names_test.py).

# `exact`: they compare, without clock or chance; what fails once is not run again.
set(exact_comms-odd-tests *)
set(exact_comms-tests Cdr/* FragmentsTest.* PiecesTest.*)
set(exact_comms-order-tests *)
set(exact_comms-network-tests Wire.* WireOf*)
set(exact_cs-tests *SafeDemands* *SafeStop* *DemandsAtRest.* *DemandQuality.* *AcceptedDemands.*
    *HandOver*)
set(exact_determinism-tests Shards/*)
set(exact_drives-tests *)
set(exact_modbus-sim-tests FramesOfSim.* InboxOfSim.* RegistersOfSim.* Ds402Registers.*)
set(exact_text-tests *)

# `whole`: dear. They do a share of their work in the gate, and all of it in stage `long`, with
# CORTEX_WHOLE set (support/share.hpp).
set(whole_cli-tests CortexTypes.PrintsEveryTypeAsJsonOfTheCommittedSchema CortexNewType.MakesFiles*)
set(whole_comms-tests Cdr/*.RefusesAMutatedOctet*)
set(whole_core-command-tests *LeaseFight.*)
set(whole_core-tests HostileXml.ManyUnknownNamesCostLittle *MutatedDescriptions.*)
set(whole_gui-tests EventRows.ARowOfMany* Events.FollowAgain* Events.SayHowMany*
    EventTab.ShowsTheDetailsOfTheSelectedRow* HostileModels.*)

# `long`: the same each time, but dear. With a share of the work the gate has others like them.
set(long-exact_determinism-tests Shards/*/2 Shards/*/3)
set(long-exact_text-tests *TenThousand*)
set(long_core-tests Sending.OfATypeWithMoreText*)
set(long_integration-tests LbrTeleop/FlippedJoint.*/1 LbrTeleop/FlippedJoint.*/2
    LbrTeleop/FlippedJoint.*/3 LbrTeleop/FlippedJoint.*/4 LbrTeleop/FlippedJoint.*/5
    LbrTeleop/FlippedJoint.*/6 LbrTeleop.FollowReplacedByHold*)

set(long_process-tests ExternallyTriggeredAgent.EndsWithFour*)

# `timed`: they judge time, or need CPUs that nobody else uses, or take them all with a priority.
set(timed_cli-drive-tests *)
set(timed_cli-live-tests CortexShipped.* CortexControl.TakeCommands*
    CortexControl.AnInterruptReleases*)
set(timed_comms-network-tests Leases.AreRenewed*)
set(timed_cs-tests *CostlyTasks.* ClusterCS.SharesCostlyTasks* ClusterCS.GivesItsPriority*
    ThreadPool.EndsEveryCycleWithMoreRealtimeThreadsThanCpus*)
set(timed_gui-live-tests Controlling.KeepsWhatIsHandedOver*)
set(timed_gui-motion-tests JoggingProcess.*)
set(timed_gui-network-tests CutLink.LosesNothing*)
set(timed_gui-session-tests Session.TakesValues*)
set(timed_network-tests AttackedPlant.* TwoHosts.* Stations.*)
set(timed_process-tests EndOfAProcess.* TwoAgents.*Killed* TwoAgents.*Hold*
    RetainedValues.LoseAtMost*)

# `also`: of those that judge time, one of each stands in the gate, too, and judges in cycles there.
set(also_gui-motion-tests JoggingProcess.*Killed)
set(also_process-tests EndOfAProcess.*NobodyReads* TwoAgents.TheArmHolds*)
