/* design/solver/solver_ceres.cc - the minimiser: Ceres, kept silent, behind a C function. */
/* SPDX-License-Identifier: MIT */
extern "C" {
#include "design/solver/solver_engine.h"
}

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>
#include <vector>

namespace
{

/* The free parameters among all, and residuals and derivatives at the point last asked for. */
class Model
{
  public:
    explicit Model(engine_run *run) : run_(run), problem_(run->problem)
    {
        all_.assign(run->parameters, run->parameters + problem_->parameter_count);
        for (size_t i = 0; i < problem_->parameter_count; i++) {
            if (run->is_free[i]) {
                places.push_back(i);
            }
        }
        residuals.resize(problem_->residual_count);
        jacobian.resize(problem_->residual_count * problem_->parameter_count);
    }

    const double *scatter(const double *free)
    {
        for (size_t i = 0; i < places.size(); i++) {
            all_[places[i]] = free[i];
        }
        return all_.data();
    }

    /* An exception must not cross the caller's C, nor his NaN Ceres. */
    bool compute(const double *free, bool derivatives)
    {
        run_->evaluations++;
        run_->derivatives += derivatives;
        good = problem_->evaluate(problem_->context, scatter(free), residuals.data(),
                                  derivatives ? jacobian.data() : nullptr) &&
               finite(residuals) && (!derivatives || finite(jacobian));
        return good;
    }

    /* Rows of the derivatives from `first` on, of the free parameters. */
    void copy(size_t first, size_t rows, double *to) const
    {
        const double *row = &jacobian[first * problem_->parameter_count];
        for (size_t i = 0; i < rows; i++, row += problem_->parameter_count) {
            for (size_t at : places) {
                *to++ = row[at];
            }
        }
    }

    std::vector<size_t> places; /* of the free parameters */
    std::vector<double> residuals, jacobian;
    bool good = false;

  private:
    static bool finite(const std::vector<double> &values)
    {
        return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
    }

    engine_run *run_;
    const solver_problem *problem_;
    std::vector<double> all_;
};

/* All residuals at once, computed where they are asked for; or one observation: its part of what
   Together computed. */
class Part final : public ceres::CostFunction
{
  public:
    Part(Model *model, size_t first, size_t rows, bool is_whole)
        : model_(model), first_(first), rows_(rows), is_whole_(is_whole)
    {
        set_num_residuals(static_cast<int>(rows));
        mutable_parameter_block_sizes()->push_back(static_cast<int>(model->places.size()));
    }

    bool Evaluate(double const *const *parameters, double *residuals,
                  double **jacobians) const override
    {
        bool derivatives = jacobians != nullptr && jacobians[0] != nullptr;
        if (is_whole_ ? !model_->compute(parameters[0], derivatives) : !model_->good) {
            return false;
        }
        std::copy_n(&model_->residuals[first_], rows_, residuals);
        if (derivatives) {
            model_->copy(first_, rows_, jacobians[0]);
        }
        return true;
    }

  private:
    Model *model_;
    size_t first_, rows_;
    bool is_whole_;
};

/* Computes for all observations before Ceres asks each. */
class Together final : public ceres::EvaluationCallback
{
  public:
    Together(Model *model, const double *parameters) : model_(model), parameters_(parameters)
    {
    }

    void PrepareForEvaluation(bool derivatives, bool new_point) override
    {
        if (new_point || derivatives) {
            model_->compute(parameters_, derivatives);
        }
    }

  private:
    Model *model_;
    const double *parameters_;
};

class Watch final : public ceres::IterationCallback
{
  public:
    Watch(engine_run *run, Model *model, const double *parameters)
        : run_(run), model_(model), parameters_(parameters)
    {
    }

    ceres::CallbackReturnType operator()(const ceres::IterationSummary &summary) override
    {
        /* of a step that was taken back it tells the cost there */
        cost_ = summary.step_is_successful ? summary.cost : cost_;
        bool on = run_->watch(run_->watch_context, summary.iteration, cost_,
                              model_->scatter(parameters_));
        return on ? ceres::SOLVER_CONTINUE : ceres::SOLVER_TERMINATE_SUCCESSFULLY;
    }

  private:
    engine_run *run_;
    Model *model_;
    const double *parameters_;
    double cost_ = 0;
};

ceres::LossFunction *loss_of(const solver_block &block)
{
    switch (block.loss) {
    case LOSS_HUBER:
        return new ceres::HuberLoss(block.scale);
    case LOSS_SOFT_L1:
        return new ceres::SoftLOneLoss(block.scale);
    case LOSS_CAUCHY:
        return new ceres::CauchyLoss(block.scale);
    case LOSS_NONE:
        break;
    }
    return nullptr;
}

void add_residuals(const solver_problem *from, Model *model, double *parameters,
                   ceres::Problem *problem)
{
    if (from->blocks == nullptr) {
        problem->AddResidualBlock(new Part(model, 0, from->residual_count, true), nullptr,
                                  parameters);
        return;
    }
    size_t first = 0;
    for (size_t i = 0; i < from->block_count; i++) {
        const solver_block &block = from->blocks[i];
        if (block.residuals > 0) {
            problem->AddResidualBlock(new Part(model, first, block.residuals, false),
                                      loss_of(block), parameters);
        }
        first += block.residuals;
    }
}

ceres::Solver::Options options_of(const solver_options &from)
{
    ceres::Solver::Options options;
    options.minimizer_type = ceres::TRUST_REGION;
    options.trust_region_strategy_type = ceres::LEVENBERG_MARQUARDT;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = from.iterations;
    options.function_tolerance = from.function;
    options.gradient_tolerance = from.gradient;
    options.parameter_tolerance = from.parameter;
    options.initial_trust_region_radius = from.initial_trust;
    options.max_num_consecutive_invalid_steps = 20;
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    options.minimizer_progress_to_stdout = false;
    options.update_state_every_iteration = true;
    return options;
}

engine_end end_of(ceres::TerminationType type)
{
    switch (type) {
    case ceres::CONVERGENCE:
        return ENGINE_CONVERGED;
    case ceres::NO_CONVERGENCE:
        return ENGINE_LIMIT;
    case ceres::USER_SUCCESS:
        return ENGINE_WATCHED;
    default:
        return ENGINE_FAILED;
    }
}

/*
 * Has it ended on a slope? Where the trust region shrinks to nothing, or its steps become too short
 * to count, Ceres calls that convergence. At a minimum no column of the derivatives has a share of
 * the residuals, or they are nothing, or the column is: the end of a plateau. On a
 * bound rounds go on.
 */
bool is_stuck(const ceres::Solver::Summary &summary, std::vector<double> *parameters,
              ceres::Problem *problem)
{
    std::vector<double> residuals, gradient;
    ceres::CRSMatrix jacobian;
    double cost = 0, square = 0;
    if (summary.termination_type != ceres::CONVERGENCE ||
        !problem->Evaluate({}, &cost, &residuals, &gradient, &jacobian) ||
        !(cost > 1e-20 * summary.initial_cost)) {
        return false;
    }
    for (double residual : residuals) {
        square += residual * residual;
    }
    std::vector<double> slope(gradient.size(), 0);
    for (size_t i = 0; i < jacobian.values.size(); i++) {
        slope[static_cast<size_t>(jacobian.cols[i])] += jacobian.values[i] * jacobian.values[i];
    }
    bool is_sloping = false;
    for (size_t j = 0; j < gradient.size(); j++) {
        const double at = (*parameters)[j], g = std::fabs(gradient[j]), x = std::fabs(at);
        const int k = static_cast<int>(j);
        if (at <= problem->GetParameterLowerBound(parameters->data(), k) ||
            at >= problem->GetParameterUpperBound(parameters->data(), k)) {
            return false;
        }
        const bool counts = slope[j] * x * x > 1e-18 * square;
        is_sloping =
            is_sloping || (counts && g * g > 1e-6 * square * slope[j] && g > 1e-6 * x * slope[j]);
    }
    return is_sloping;
}

void minimize(engine_run *run)
{
    Model model(run);
    std::vector<double> parameters;
    for (size_t at : model.places) {
        parameters.push_back(run->parameters[at]);
    }
    Together together(&model, parameters.data());
    Watch watch(run, &model, parameters.data());
    ceres::Problem::Options ways;
    ways.evaluation_callback = run->problem->blocks != nullptr ? &together : nullptr;
    ceres::Problem problem(ways);
    problem.AddParameterBlock(parameters.data(), static_cast<int>(parameters.size()));
    add_residuals(run->problem, &model, parameters.data(), &problem);
    for (size_t i = 0; i < model.places.size(); i++) {
        size_t at = model.places[i];
        double low = run->problem->low != nullptr ? run->problem->low[at] : -INFINITY;
        double high = run->problem->high != nullptr ? run->problem->high[at] : INFINITY;
        if (std::isfinite(low)) {
            problem.SetParameterLowerBound(parameters.data(), static_cast<int>(i), low);
        }
        if (std::isfinite(high)) {
            problem.SetParameterUpperBound(parameters.data(), static_cast<int>(i), high);
        }
    }
    ceres::Solver::Options options = options_of(run->options);
    options.callbacks.push_back(&watch);
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    run->end =
        is_stuck(summary, &parameters, &problem) ? ENGINE_FAILED : end_of(summary.termination_type);
    run->iterations = static_cast<int>(summary.iterations.size());
    run->iterations -= run->iterations > 0;
    snprintf(run->message, sizeof run->message, "%s", summary.message.c_str());
    const double *best = model.scatter(parameters.data());
    std::copy(best, best + run->problem->parameter_count, run->parameters);
}

} // namespace

extern "C" void ceres_minimize(engine_run *run)
{
    /* nothing of its log reaches standard error */
    FLAGS_minloglevel = google::GLOG_FATAL;
    /* an exception on its way through what runs threads would abort */
    std::set_new_handler(arena_end);
    try {
        minimize(run);
    } catch (const std::bad_alloc &) {
        run->end = ENGINE_NO_MEMORY;
    } catch (const std::exception &trouble) {
        run->end = ENGINE_FAILED;
        snprintf(run->message, sizeof run->message, "%s", trouble.what());
    } catch (...) {
        run->end = ENGINE_FAILED;
        snprintf(run->message, sizeof run->message, "an unknown exception");
    }
}
