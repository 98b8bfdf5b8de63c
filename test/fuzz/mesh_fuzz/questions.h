// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fuzz/mesh_fuzz/fuzz_case.h"

namespace kios::fuzz {

// Each asks its case and returns what is wrong with the answers, if anything.

Verdict askKernel(const Case& c);      ///< the triangle kernels, against integers
Verdict askDistance(const Case& c);    ///< fcl::distance
Verdict askBracket(const Case& c);     ///< kios::distanceBracket with any options
Verdict askCloser(const Case& c);      ///< kios::closerThan
Verdict askContacts(const Case& c);    ///< fcl::collide
Verdict askRay(const Case& c);         ///< firstHit, anyHit, allHits
Verdict askPoint(const Case& c);       ///< nearest points, winding numbers
Verdict askShape(const Case& c);       ///< a mesh and one of FCL's shapes
Verdict askScene(const Case& c);       ///< SceneDistance over frames
Verdict askManager(const Case& c);     ///< ManagerQuery with an FCL manager
Verdict askRefit(const Case& c);       ///< models that were replaced, updated or copied
Verdict askContinuous(const Case& c);  ///< kios::firstContact
Verdict askLinkage(const Case& c);     ///< kios::checkMotion
Verdict askDepth(const Case& c);       ///< kios::localDepth
Verdict askClashes(const Case& c);     ///< kios::findClashes
Verdict askChanging(const Case& c);    ///< scenes whose geometries change in place

}  // namespace kios::fuzz
