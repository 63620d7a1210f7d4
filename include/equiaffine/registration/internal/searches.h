// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_SEARCHES_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_SEARCHES_H

#include <equiaffine/registration/internal/declared_searches.h>

#include <Eigen/Core>

// The target equiaffine::compiled has the definitions, compiled once. A program for vector instructions with which Eigen
// aligns memory to more bytes has its own: it could not free what that library allocates.
#if !defined(EQUIAFFINE_COMPILED) || EIGEN_DEFAULT_ALIGN_BYTES != 16
#include <equiaffine/registration/internal/pieces/contradictions_of_triangles.h>
#include <equiaffine/registration/internal/registration.h>
#include <equiaffine/registration/internal/registration_of_triangles.h>
#include <equiaffine/registration/internal/symmetries.h>
#include <equiaffine/registration/internal/wholes/differ_as_wholes.h>
#endif

#endif
