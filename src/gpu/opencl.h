#ifndef OUTDOOR_OMR_GPU_OPENCL_H
#define OUTDOOR_OMR_GPU_OPENCL_H

/** The one place that includes OpenCL; Ubuntu 20.04 has cl2.hpp only. */

#define CL_HPP_ENABLE_EXCEPTIONS
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_TARGET_OPENCL_VERSION 120
#if __has_include(<CL/opencl.hpp>)
#include <CL/opencl.hpp>
#else
#include <CL/cl2.hpp>
#endif

#endif
